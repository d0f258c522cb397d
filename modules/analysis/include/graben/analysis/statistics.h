#pragma once

#include <cstddef>
#include <vector>

namespace graben {

/// Distances in a few figures, in the unit of the coordinates; all zero where count is 0.
struct DistanceStatistics {
  std::size_t count = 0;
  double mean_square = 0.0;
  double rms = 0.0;
  double mean = 0.0;
  double p50 = 0.0;
  double p95 = 0.0;
  double max = 0.0;
};

/// O(n); sums block by block in the order given, so the result depends on the values alone.
/// \param[in] distances none negative or NaN
/// \param[in] threads   0: one per processor
DistanceStatistics distanceStatistics(std::vector<double> distances, unsigned threads = 0);

/// The smallest value that at least the share \a q (0 to 1) of the values does not exceed; 0 if
/// there are none. Reorders \a values; O(n).
double quantile(std::vector<double>& values, double q);

/// The place, from 0, of that value among \a count sorted ones, 1 or more.
std::size_t rankOf(std::size_t count, double q);

/// The values of single ranks among many, found without sorting; the same for any number of threads.
class RankSearch {
public:
  /// O(n). \param[in] values kept by reference; none negative or NaN
  /// \param[in] threads 0: one per processor
  explicit RankSearch(const std::vector<double>& values, unsigned threads = 0);

  /// The value that comes at place \a rank, from 0, in rising order; there must be so many. O(n)
  double value(std::size_t rank) const;

private:
  const std::vector<double>& values_;
  unsigned threads_;
  std::vector<std::size_t> bins_; ///< how many values have the same leading bits
};

} // namespace graben
