#pragma once

#include "graben/core/export.h"

#include <cstddef>
#include <vector>

GRABEN_EXPORT_BEGIN
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

} // namespace graben
GRABEN_EXPORT_END
