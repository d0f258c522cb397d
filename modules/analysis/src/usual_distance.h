#pragma once

#include "graben/analysis/fault_throw.h"

#include <algorithm>
#include <vector>

namespace graben {

/// Where two samples are farther apart along the fault than so many usual distances, no throw was read off between them.
constexpr double kGapInSamples = 5.0;

/// The median distance between samples along a fault; 0 with less than two.
inline double usualDistance(const std::vector<ThrowSample>& samples) {
  std::vector<double> steps;
  for (std::size_t i = 0; i + 1 < samples.size(); ++i)
    steps.push_back(samples[i + 1].along - samples[i].along);
  if (steps.empty())
    return 0.0;
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle;
}

} // namespace graben
