#pragma once

#include "graben/core/export.h"

#include <cstddef>
#include <vector>

GRABEN_EXPORT_BEGIN
namespace graben {

/// The place, from 0, of that value among \a count sorted ones, 1 or more, that at least the share \a q (0 to 1) of them does not exceed.
std::size_t rankOf(std::size_t count, double q);

/// The values of a few ranks among many values that are seen bit by bit and need not be kept: a sample of them tells between which bounds each value
/// wanted must lie, and only those between are kept.
///
/// Where all are seen in blocks, by any number of threads, each block has a tally of its own. If a value wanted turns out to lie beyond its bounds (the
/// sample was not like the rest), all are to be seen once more.
class RankSearch {
public:
  /// Every how manieth of \a count values makes a good sample.
  static std::size_t sampleStep(std::size_t count) { return 1 + count / 4096; }

  /// \param[in] sample some of the values, from everywhere; none NaN; may be empty
  /// \param[in] count  of all values
  /// \param[in] ranks  places, from 0, in rising order of the values: each less than \a count
  RankSearch(std::vector<double> sample, std::size_t count, const std::vector<std::size_t>& ranks);

  /// What has been seen of some of the values.
  class Tally {
  public:
    explicit Tally(const RankSearch& search) : search_(&search), counts_(search.bounds_.size()) {}

    void see(const double* values, std::size_t count);

  private:
    friend class RankSearch;
    struct Counts {
      std::size_t below = 0;
      std::size_t at_low = 0;
      std::size_t at_high = 0;
      std::vector<double> between;

      void keep(const double* inside, std::size_t count, double low, double high);
    };

    const RankSearch* search_;
    std::vector<Counts> counts_; ///< for each rank
  };

  /// After each value was seen once. \param[out] values of the ranks
  /// \return false if all are to be seen once more, with the same search and new tallies
  bool find(const std::vector<Tally>& tallies, std::vector<double>& values);

private:
  struct Bounds {
    std::size_t rank;
    double low, high;
  };
  std::vector<Bounds> bounds_;
};

} // namespace graben
GRABEN_EXPORT_END
