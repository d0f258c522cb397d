#pragma once

#include "graben/core/export.h"
#include "graben/surface/carried_fields.h"
#include "graben/surface/hoppe_marching_cubes.h"

#include <pcl/console/print.h>
#include <pcl/conversions.h>

#include <algorithm>
#include <exception>
#include <new>

GRABEN_EXPORT_BEGIN
namespace graben {

template <typename PointNT>
HoppeMarchingCubes<PointNT>::HoppeMarchingCubes(float dist_ignore, float percentage_extend_grid,
                                                float iso_level)
    : Base(dist_ignore, percentage_extend_grid, iso_level) {
  this->check_tree_ = false;
  res_x_ = res_y_ = res_z_ =
      0; // setGridResolution cannot be overridden: 0 tells that it was not called
}

template <typename PointNT>
bool HoppeMarchingCubes<PointNT>::fail(const std::string& message) {
  status_ = SurfaceStatus::Failed;
  message_ = message;
  surface_.cut = {};
  PCL_ERROR("[graben::%s::reconstruct] %s\n", getClassName().c_str(), message.c_str());
  return false;
}

template <typename PointNT>
bool HoppeMarchingCubes<PointNT>::begin() {
  status_ = SurfaceStatus::NotRun;
  message_.clear();
  surface_ = {};
  vertex_faults_.clear();
  used_.clear();
  skipped_ = 0;
  if (!input_ || input_->empty())
    return fail("The input cloud is missing or empty.");
  if (!initCompute())
    return fail("The indices do not fit the input cloud.");
  return true;
}

/// Nothing leaves it: what is thrown becomes a failure.
template <typename PointNT>
template <typename Work>
void HoppeMarchingCubes<PointNT>::orFail(const Work& work) {
  try {
    work();
  } catch (const std::bad_alloc&) {
    fail("There is not enough memory; use a larger voxel size.");
  } catch (const std::exception& error) {
    fail(error.what());
  }
}

template <typename PointNT>
void HoppeMarchingCubes<PointNT>::reconstruct(pcl::PolygonMesh& output) {
  const pcl::PCLHeader header = input_ ? input_->header : pcl::PCLHeader();
  orFail([&] {
    output = pcl::PolygonMesh();
    if (!begin())
      return;
    performReconstruction(output);
    deinitCompute();
  });
  if (status_ == SurfaceStatus::Failed)
    output = pcl::PolygonMesh();
  output.header = output.cloud.header = header;
}

template <typename PointNT>
void HoppeMarchingCubes<PointNT>::reconstruct(pcl::PointCloud<PointNT>& points,
                                              std::vector<pcl::Vertices>& polygons) {
  const pcl::PCLHeader header = input_ ? input_->header : pcl::PCLHeader();
  orFail([&] {
    polygons.clear();
    if (!begin())
      return;
    performReconstruction(points, polygons);
    deinitCompute();
  });
  if (status_ == SurfaceStatus::Failed) {
    points.clear();
    polygons.clear();
  }
  points.header = header;
}

template <typename PointNT>
void HoppeMarchingCubes<PointNT>::sayWhatLooksWrong() {
  if (tree_)
    surface_.warnings.push_back("The search method that was set is not used: neighbours come from a grid that finds the same ones.");
  for (const std::string& warning : surface_.warnings) {
    message_ += (message_.empty() ? "" : " ") + warning;
    PCL_WARN("[graben::%s::reconstruct] %s\n", getClassName().c_str(), warning.c_str());
  }
}

template <typename PointNT>
bool HoppeMarchingCubes<PointNT>::collect(Points& points, Points& normals) {
  constexpr float kShortest = 0.5F;
  points.reserve(indices_->size());
  normals.reserve(indices_->size());
  const auto size = static_cast<pcl::index_t>(input_->size());
  for (const pcl::index_t i : *indices_) {
    if (i < 0 || i >= size)
      return fail("An index lies outside the input cloud.");
    const PointNT& p = (*input_)[static_cast<std::size_t>(i)];
    const auto normal = p.getNormalVector3fMap();
    if (!p.getVector3fMap().allFinite() || !normal.allFinite() || !(normal.norm() > kShortest))
      continue;
    points.push_back(p.getVector3fMap().template cast<double>());
    normals.push_back(normal.template cast<double>().normalized());
    used_.push_back(i);
  }
  skipped_ = indices_->size() - points.size();
  return points.empty() ? fail("No point is finite and has a normal.") : true;
}

template <typename PointNT>
HoppeSurfaceOptions HoppeMarchingCubes<PointNT>::options() const {
  HoppeSurfaceOptions o = options_;
  o.resolution = {res_x_, res_y_, res_z_};
  o.box_extension = static_cast<double>(percentage_extend_grid_);
  o.distance_limit = static_cast<double>(dist_ignore_);
  o.iso_level = static_cast<double>(iso_level_);
  return o;
}

template <typename PointNT>
void HoppeMarchingCubes<PointNT>::voxelizeData() {
  if (!input_ || !indices_) {
    fail("There is no input cloud, or reconstruct() was not called.");
    return;
  }
  orFail([&] {
    used_.clear();
    Points points;
    Points normals;
    if (!collect(points, normals))
      return;
    HoppeSurfaceOptions o = options();
    o.find_picks = transfer_fields_ && detail::hasFieldsToCarry<PointNT>();
    const FaultNetwork no_faults;
    surface_ = hoppeSurface(points, normals, faults_ ? *faults_ : no_faults, o);
    vertex_faults_ = surface_.cut.vertex_faults;
    status_ = SurfaceStatus::Complete;
    sayWhatLooksWrong();
  });
}

template <typename PointNT>
void HoppeMarchingCubes<PointNT>::performReconstruction(pcl::PolygonMesh& output) {
  pcl::PointCloud<PointNT> points;
  performReconstruction(points, output.polygons);
  pcl::toPCLPointCloud2(points, output.cloud);
}

template <typename PointNT>
void HoppeMarchingCubes<PointNT>::performReconstruction(pcl::PointCloud<PointNT>& points,
                                                        std::vector<pcl::Vertices>& polygons) {
  voxelizeData();
  const TriangleMesh& mesh = surface_.cut.mesh;
  const pcl::PCLHeader header = input_ ? input_->header : pcl::PCLHeader();
  pcl::PointCloud<PointNT> made; // points may be the input itself
  made.header = header;
  made.resize(mesh.vertices.size());
  for (std::size_t v = 0; v < surface_.picks.size(); ++v)
    if (surface_.picks[v] >= 0)
      made[v] = (*input_)[static_cast<std::size_t>(used_[static_cast<std::size_t>(surface_.picks[v])])];
  points = std::move(made);
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    points[v].getVector3fMap() = mesh.vertices[v].template cast<float>();
    points[v].getNormalVector3fMap() = mesh.normals[v].template cast<float>();
  }
  polygons.assign(mesh.triangles.size(), pcl::Vertices());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    polygons[t].vertices.assign(mesh.triangles[t].begin(), mesh.triangles[t].end());
  surface_.cut = {};
}

} // namespace graben
GRABEN_EXPORT_END

#define PCL_INSTANTIATE_HoppeMarchingCubes(T)                                                      \
  template class PCL_EXPORTS graben::HoppeMarchingCubes<T>;
