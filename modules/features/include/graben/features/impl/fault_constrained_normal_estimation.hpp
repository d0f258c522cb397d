#pragma once

#include "graben/core/export.h"
#include "graben/faults/out_of_reach.h"
#include "graben/features/fault_constrained_normal_estimation.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <new>

GRABEN_EXPORT_BEGIN
namespace graben {
namespace detail {

template <typename PointT>
Points toPoints(const pcl::PointCloud<PointT>& cloud) {
  Points points;
  points.reserve(cloud.size());
  for (const PointT& p : cloud)
    points.emplace_back(p.x, p.y, p.z);
  return points;
}

template <typename PointT>
Points toPoints(const pcl::PointCloud<PointT>& cloud, const pcl::Indices& indices) {
  Points points;
  points.reserve(indices.size());
  for (const pcl::index_t i : indices) {
    const PointT& p = cloud[static_cast<std::size_t>(i)];
    points.emplace_back(p.x, p.y, p.z);
  }
  return points;
}

} // namespace detail

template <typename PointInT, typename PointOutT>
FaultConstrainedNormalEstimation<PointInT, PointOutT>::FaultConstrainedNormalEstimation(
    unsigned int nr_threads)
    : Base(nr_threads) {
  feature_name_ = "FaultConstrainedNormalEstimation";
}

template <typename PointInT, typename PointOutT>
void FaultConstrainedNormalEstimation<PointInT, PointOutT>::setInputCloud(
    const PointCloudConstPtr& cloud) {
  if (cloud)
    Base::setInputCloud(cloud);
  else
    input_.reset();
}

template <typename PointInT, typename PointOutT>
bool FaultConstrainedNormalEstimation<PointInT, PointOutT>::fail(const std::string& message) {
  status_ = NormalEstimationStatus::Failed;
  message_ = message;
  PCL_ERROR("[graben::%s::compute] %s\n", getClassName().c_str(), message.c_str());
  return false;
}

template <typename PointInT, typename PointOutT>
void FaultConstrainedNormalEstimation<PointInT, PointOutT>::warn(const std::string& message) {
  message_ += (message_.empty() ? "" : " ") + message;
  PCL_WARN("[graben::%s::compute] %s\n", getClassName().c_str(), message.c_str());
}

template <typename PointInT, typename PointOutT>
void FaultConstrainedNormalEstimation<PointInT, PointOutT>::compute(PointCloudOut& output) {
  try {
    Base::compute(output);
  } catch (const std::exception&) { // the output could not be resized
    fail("There is not enough memory.");
    this->deinitCompute();
    output.clear();
  }
}

template <typename PointInT, typename PointOutT>
bool FaultConstrainedNormalEstimation<PointInT, PointOutT>::initCompute() {
  status_ = NormalEstimationStatus::NotRun;
  message_.clear();
  result_rho_ = result_delta_ = 0.0;
  if (!input_ || input_->empty())
    return fail("The input cloud is missing or empty.");
  if (!pcl::PCLBase<PointInT>::initCompute())
    return fail("The indices do not fit the input cloud.");
  const auto size = static_cast<pcl::index_t>(input_->size());
  if (std::any_of(indices_->begin(), indices_->end(),
                  [size](pcl::index_t i) { return i < 0 || i >= size; }))
    return fail("An index lies outside the input cloud.");
  if (search_radius_ != 0.0 && k_ != 0)
    return fail("Both a radius and a number of neighbours are set; set one of them to zero.");
  if (search_radius_ < 0.0 || (k_ != 0 && k_ < 3))
    return fail("The radius must be positive and the number of neighbours 3 or more.");
  if (!surface_) {
    fake_surface_ = true;
    surface_ = input_;
  }
  return true;
}

template <typename PointInT, typename PointOutT>
CloudNormalOptions FaultConstrainedNormalEstimation<PointInT, PointOutT>::options() const {
  constexpr std::size_t MOST_IN_RADIUS = 1000;
  CloudNormalOptions options;
  if (search_radius_ > 0.0)
    options.planes.neighbors = MOST_IN_RADIUS;
  else if (k_ > 0)
    options.planes.neighbors = static_cast<std::size_t>(k_);
  options.planes.max_distance = search_radius_;
  options.planes.threads = threads_;
  options.rho = rho_;
  options.delta = delta_;
  options.orientation = orientation_;
  options.up = up_.template cast<double>();
  options.viewpoint = Vector3(this->vpx_, this->vpy_, this->vpz_);
  return options;
}

template <typename PointInT, typename PointOutT>
void FaultConstrainedNormalEstimation<PointInT, PointOutT>::computeFeature(PointCloudOut& output) {
  try {
    estimate(output);
    return;
  } catch (const std::bad_alloc&) {
    fail("There is not enough memory.");
  } catch (const std::exception& error) {
    fail(error.what());
  }
  result_rho_ = result_delta_ = 0.0;
  fill({}, {}, output);
}

template <typename PointInT, typename PointOutT>
void FaultConstrainedNormalEstimation<PointInT, PointOutT>::estimate(PointCloudOut& output) {
  const FaultNetwork no_faults;
  const FaultNetwork& faults = faults_ ? *faults_ : no_faults;
  const Points surface = detail::toPoints(*surface_);
  const bool own_points = surface_ == input_;
  const bool all_points = own_points && indices_->size() == input_->size();
  // The whole surface is needed to orient it; else a subset is cheaper alone.
  const bool whole = all_points || (own_points && orientation_ == NormalOrientation::SpanningTree);
  std::vector<Index> rows(indices_->begin(), indices_->end());
  CloudNormals normals;
  if (whole) {
    normals = estimateCloudNormals(surface, faults, options());
  } else {
    const Points places = detail::toPoints(*input_, *indices_);
    normals = estimateCloudNormals(surface, faults, options(), &places);
    for (std::size_t i = 0; i < rows.size(); ++i)
      rows[i] = static_cast<Index>(i);
  }
  result_rho_ = normals.rho;
  result_delta_ = normals.delta;
  fill(normals, rows, output);
  if (status_ == NormalEstimationStatus::Failed)
    return;
  const double step = std::isfinite(result_rho_ + result_delta_) ? result_rho_ + result_delta_ : boundsOf(surface).diagonal();
  if (const std::string odd = faultsOutOfReach(faults, boundsOf(surface), step, "points"); !odd.empty())
    warn(odd);
  if (tree_)
    warn("The search method that was set is not used: neighbours come from a grid that finds the same ones.");
}

/// Row i of the output takes plane rows[i]; NaN where there is no row.
template <typename PointInT, typename PointOutT>
void FaultConstrainedNormalEstimation<PointInT, PointOutT>::fill(const CloudNormals& normals,
                                                                 const std::vector<Index>& rows,
                                                                 PointCloudOut& output) {
  std::size_t found = 0;
  for (std::size_t i = 0; i < output.size(); ++i) {
    PointOutT& out = output[i];
    out.normal_x = out.normal_y = out.normal_z = out.curvature =
        std::numeric_limits<float>::quiet_NaN();
    if (i >= rows.size())
      continue;
    const auto row = static_cast<std::size_t>(rows[i]);
    const Vector3& normal = normals.planes.normals[row];
    if (!normal.allFinite())
      continue;
    out.getNormalVector3fMap() = normal.template cast<float>();
    out.curvature = normals.planes.curvature[row];
    ++found;
  }
  output.is_dense = found == output.size();
  if (status_ == NormalEstimationStatus::Failed)
    return;
  if (found == 0)
    fail("No point has enough neighbours for a plane.");
  else
    status_ =
        output.is_dense ? NormalEstimationStatus::Complete : NormalEstimationStatus::Incomplete;
}

} // namespace graben
GRABEN_EXPORT_END

#define PCL_INSTANTIATE_FaultConstrainedNormalEstimation(T, NT)                                    \
  template class PCL_EXPORTS graben::FaultConstrainedNormalEstimation<T, NT>;
