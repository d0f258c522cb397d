#pragma once

#include "graben/core/errors.h"
#include "graben/filters/fault_filter.h"

#include <pcl/filters/impl/filter_indices.hpp>

#include <algorithm>

namespace graben {

/// Nothing if there was an error.
template <typename PointT>
std::vector<bool> FaultFilter<PointT>::chooseOrFail(const Points& points) {
  message_.clear();
  clearResult();
  const auto size = static_cast<pcl::index_t>(points.size());
  if (std::any_of(indices_->begin(), indices_->end(),
                  [size](pcl::index_t i) { return i < 0 || i >= size; })) {
    message_ = "An index lies outside the input cloud.";
  } else {
    try {
      const FaultNetwork none;
      std::vector<bool> chosen = choose(points, faults_ ? *faults_ : none);
      status_ = FilterStatus::Complete;
      return chosen;
    } catch (const Error& error) {
      clearResult();
      message_ = error.what();
    }
  }
  status_ = FilterStatus::Failed;
  PCL_ERROR("[graben::%s::applyFilter] %s\n", getClassName().c_str(), message_.c_str());
  return {};
}

template <typename PointT>
void FaultFilter<PointT>::applyFilter(pcl::Indices& indices) {
  Points points;
  points.reserve(input_->size());
  for (const PointT& p : *input_)
    points.emplace_back(p.x, p.y, p.z);
  const std::vector<bool> chosen = chooseOrFail(points);
  const pcl::Indices candidates = *indices_; // the output may be the same object
  indices.clear();
  removed_indices_->clear();
  for (const pcl::index_t i : candidates) {
    const auto at = static_cast<std::size_t>(i);
    if (!chosen.empty() && points[at].allFinite() && chosen[at] != negative_)
      indices.push_back(i);
    else if (extract_removed_indices_ && at < points.size())
      removed_indices_->push_back(i);
  }
}

} // namespace graben

#define PCL_INSTANTIATE_FaultFilter(T) template class PCL_EXPORTS graben::FaultFilter<T>;
