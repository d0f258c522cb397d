#pragma once

#include "graben/core/export.h"
#include "graben/filters/fault_filter.h"

#include <pcl/filters/impl/filter_indices.hpp>

#include <algorithm>
#include <exception>
#include <new>

GRABEN_EXPORT_BEGIN
namespace graben {

template <typename PointT>
void FaultFilter<PointT>::warn(const std::string& message) {
  message_ = message;
  PCL_WARN("[graben::%s::applyFilter] %s\n", getClassName().c_str(), message.c_str());
}

template <typename PointT>
void FaultFilter<PointT>::fail(const std::string& message) {
  clearResult();
  status_ = FilterStatus::Failed;
  message_ = message;
  PCL_ERROR("[graben::%s::applyFilter] %s\n", getClassName().c_str(), message.c_str());
}

/// Nothing if there was an error.
template <typename PointT>
std::vector<bool> FaultFilter<PointT>::chooseOrFail(const Points& points) {
  if (this->fake_indices_ && indices_->size() != points.size())
    throw std::bad_alloc(); // which PCL has kept to itself
  const auto size = static_cast<pcl::index_t>(points.size());
  if (std::any_of(indices_->begin(), indices_->end(),
                  [size](pcl::index_t i) { return i < 0 || i >= size; })) {
    fail("An index lies outside the input cloud.");
    return {};
  }
  const FaultNetwork none;
  std::vector<bool> chosen = choose(points, faults_ ? *faults_ : none);
  status_ = FilterStatus::Complete;
  return chosen;
}

/// \param[in] chosen empty: none is
template <typename PointT>
void FaultFilter<PointT>::select(const Points& points, const std::vector<bool>& chosen, pcl::Indices& indices) {
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

template <typename PointT>
void FaultFilter<PointT>::applyFilter(pcl::Indices& indices) {
  message_.clear();
  clearResult();
  try {
    Points points;
    points.reserve(input_->size());
    for (const PointT& p : *input_)
      points.emplace_back(p.x, p.y, p.z);
    select(points, chooseOrFail(points), indices);
    return;
  } catch (const std::bad_alloc&) {
    fail("There is not enough memory.");
  } catch (const std::exception& error) {
    fail(error.what());
  }
  indices.clear();
  removed_indices_->clear();
  if (extract_removed_indices_)
    *removed_indices_ = *indices_;
}

template <typename PointT>
template <typename Output>
void FaultFilter<PointT>::filterOrFail(Output& output) {
  status_ = FilterStatus::NotRun;
  try {
    pcl::FilterIndices<PointT>::filter(output);
    if (status_ == FilterStatus::NotRun)
      fail("The input cloud is missing.");
  } catch (const std::exception&) { // outside applyFilter(), PCL only copies
    fail("There is not enough memory.");
  }
  if (status_ == FilterStatus::Failed && !this->keep_organized_)
    output.clear();
}

template <typename PointT>
void FaultFilter<PointT>::filter(PointCloud& output) {
  filterOrFail(output);
}

template <typename PointT>
void FaultFilter<PointT>::filter(pcl::Indices& indices) {
  filterOrFail(indices);
}

} // namespace graben
GRABEN_EXPORT_END

#define PCL_INSTANTIATE_FaultFilter(T) template class PCL_EXPORTS graben::FaultFilter<T>;
