#pragma once

#include "graben/core/export.h"
#include "graben/core/short_number.h"
#include "graben/filters/impl/fault_filter.hpp"
#include "graben/filters/wrong_side_filter.h"

GRABEN_EXPORT_BEGIN
namespace graben {

template <typename PointT>
WrongSidePicks<PointT>::WrongSidePicks(bool extract_removed_indices)
    : FaultFilter<PointT>(extract_removed_indices) {
  this->filter_name_ = "WrongSidePicks";
}

template <typename PointT>
std::vector<bool> WrongSidePicks<PointT>::choose(const Points& points, const FaultNetwork& faults) {
  WrongSideOptions options = options_;
  options.threads = this->threads_;
  const NeighborGrid grid(points, 0.0, this->threads_);
  result_ = findWrongSidePicks(grid, faults, options);
  if (!faults.empty() && result_.judged == 0)
    this->warn("No point is within the band, " + shortNumber(result_.used.band) +
               ", of a fault. Are the faults in another frame (origin, units, or the sign of z)?");
  std::vector<bool> chosen;
  for (const PickReason reason : result_.reasons)
    chosen.push_back(reason == PickReason::Good);
  return chosen;
}

} // namespace graben
GRABEN_EXPORT_END

#define PCL_INSTANTIATE_WrongSidePicks(T) template class PCL_EXPORTS graben::WrongSidePicks<T>;
