#include "graben/analysis/statistics.h"

#include <algorithm>
#include <cmath>

namespace graben {

double quantile(std::vector<double>& values, double q) {
  if (values.empty())
    return 0.0;
  const auto count = static_cast<double>(values.size());
  const auto rank = static_cast<std::ptrdiff_t>(std::clamp(std::ceil(q * count), 1.0, count)) - 1;
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  return values[static_cast<std::size_t>(rank)];
}

DistanceStatistics distanceStatistics(std::vector<double> distances) {
  DistanceStatistics result;
  result.count = distances.size();
  if (distances.empty())
    return result;
  for (const double d : distances) {
    result.mean += d;
    result.mean_square += d * d;
    result.max = std::max(result.max, d);
  }
  const auto count = static_cast<double>(distances.size());
  result.mean /= count;
  result.mean_square /= count;
  result.rms = std::sqrt(result.mean_square);
  result.p50 = quantile(distances, 0.5);
  result.p95 = quantile(distances, 0.95);
  return result;
}

} // namespace graben
