#pragma once

#include "graben/core/export.h"
#include "graben/core/short_number.h"
#include "graben/filters/fault_distance.h"
#include "graben/filters/fault_zone.h"
#include "graben/filters/impl/fault_filter.hpp"
#include "graben/features/mean_distance.h"

#include <cmath>

GRABEN_EXPORT_BEGIN
namespace graben {

template <typename PointT>
FaultZone<PointT>::FaultZone(bool extract_removed_indices)
    : FaultFilter<PointT>(extract_removed_indices) {
  this->filter_name_ = "FaultZone";
}

template <typename PointT>
std::vector<bool> FaultZone<PointT>::choose(const Points& points, const FaultNetwork& faults) {
  constexpr double MEAN_DISTANCES = 5.0;
  used_width_ = width_;
  if (width_ == 0.0)
    used_width_ = MEAN_DISTANCES *
                  meanPickDistance(NeighborGrid(points, 0.0, this->threads_), this->threads_);
  distances_ = distancesToFaults(points, faults, used_width_, this->threads_);
  std::vector<bool> chosen;
  for (const double distance : distances_)
    chosen.push_back(std::isfinite(distance));
  if (faults.empty())
    this->warn("There are no faults, so no point is near one.");
  else if (std::none_of(chosen.begin(), chosen.end(), [](bool near) { return near; }))
    this->warn("No point is within the width, " + shortNumber(used_width_) +
               ", of a fault. Are the faults in another frame (origin, units, or the sign of z)?");
  return chosen;
}

} // namespace graben
GRABEN_EXPORT_END

#define PCL_INSTANTIATE_FaultZone(T) template class PCL_EXPORTS graben::FaultZone<T>;
