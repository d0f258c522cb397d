#pragma once

#include "graben/core/errors.h"
#include "graben/core/export.h"
#include "graben/pipeline/faulted_horizon_reconstruction.h"
#include "graben/pipeline/horizon_mesh.h"
#include "graben/surface/carried_fields.h"

#include <pcl/console/print.h>
#include <pcl/conversions.h>
#include <pcl/type_traits.h>

#include <exception>
#include <new>

GRABEN_EXPORT_BEGIN
namespace graben {

template <typename PointNT>
FaultedHorizonReconstruction<PointNT>::FaultedHorizonReconstruction() {
  this->check_tree_ = false;
}

template <typename PointNT>
void FaultedHorizonReconstruction<PointNT>::fail(const std::string& message) {
  status_ = SurfaceStatus::Failed;
  message_ = message;
  result_ = {};
  carried_ = {};
  PCL_ERROR("[graben::%s::reconstruct] %s\n", getClassName().c_str(), message.c_str());
}

template <typename PointNT>
void FaultedHorizonReconstruction<PointNT>::warn(const std::string& message) {
  message_ += (message_.empty() ? "" : "\n") + message;
  PCL_WARN("[graben::%s::reconstruct] %s\n", getClassName().c_str(), message.c_str());
}

/// Nothing leaves it: what is thrown becomes a failure.
template <typename PointNT>
template <typename Work>
void FaultedHorizonReconstruction<PointNT>::orFail(const Work& work) {
  try {
    work();
  } catch (const std::bad_alloc&) {
    fail("There is not enough memory; use a larger voxel size or fewer picks.");
  } catch (const std::exception& error) {
    fail(error.what());
  }
}

/// \throw InvalidInputError where there is no input to work on
template <typename PointNT>
void FaultedHorizonReconstruction<PointNT>::begin() {
  status_ = SurfaceStatus::NotRun;
  message_.clear();
  result_ = {};
  carried_ = {};
  if (!input_ || input_->empty())
    throw InvalidInputError("reconstruction", "The input cloud is missing or empty.");
  if (!initCompute())
    throw InvalidInputError("reconstruction", "The indices do not fit the input cloud.");
}

template <typename PointNT>
void FaultedHorizonReconstruction<PointNT>::reconstruct(pcl::PolygonMesh& output) {
  const pcl::PCLHeader header = input_ ? input_->header : pcl::PCLHeader();
  pcl::PolygonMesh made;
  orFail([&] {
    begin();
    performReconstruction(made);
    deinitCompute();
  });
  if (status_ == SurfaceStatus::Failed)
    made = pcl::PolygonMesh();
  output = std::move(made);
  output.header = output.cloud.header = header;
}

template <typename PointNT>
void FaultedHorizonReconstruction<PointNT>::reconstruct(pcl::PointCloud<PointNT>& points, std::vector<pcl::Vertices>& polygons) {
  const pcl::PCLHeader header = input_ ? input_->header : pcl::PCLHeader();
  orFail([&] {
    polygons.clear();
    begin();
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
void FaultedHorizonReconstruction<PointNT>::makeHorizon() {
  Points picks;
  picks.reserve(indices_->size());
  const auto size = static_cast<pcl::index_t>(input_->size());
  for (const pcl::index_t i : *indices_) {
    if (i < 0 || i >= size)
      throw InvalidInputError("reconstruction", "An index lies outside the input cloud.");
    const PointNT& p = (*input_)[static_cast<std::size_t>(i)];
    picks.emplace_back(p.x, p.y, p.z);
  }
  std::vector<FaultInput> faults = fault_inputs_;
  for (std::size_t f = 0; faults_ && f < faults_->size(); ++f)
    faults.push_back({faults_->fault(f).name, faults_->fault(f).mesh});
  ReconstructionOptions options = options_;
  const bool carry = transfer_fields_ && detail::hasFieldsToCarry<PointNT>();
  options.keep_picks = options.keep_picks || carry;
  result_ = HorizonReconstruction(options).reconstruct(std::move(picks), faults, dips_);
  if (carry)
    pcl::toPCLPointCloud2(pointsOfVertices(), carried_);
  status_ = SurfaceStatus::Complete;
  if (tree_)
    warn("The search method that was set is not used: neighbours come from a grid that finds the same ones.");
  for (const std::string& warning : result_.report.warnings)
    warn(warning);
}

/// A point for each vertex, with the fields of its pick.
template <typename PointNT>
pcl::PointCloud<PointNT> FaultedHorizonReconstruction<PointNT>::pointsOfVertices() const {
  pcl::PointCloud<PointNT> points;
  points.resize(result_.mesh.vertices.size());
  const std::vector<Index> picks = picksOfVertices(result_, options_.threads);
  for (std::size_t v = 0; v < picks.size(); ++v)
    if (picks[v] >= 0)
      points[v] = (*input_)[static_cast<std::size_t>((*indices_)[static_cast<std::size_t>(picks[v])])];
  return points;
}

template <typename PointNT>
void FaultedHorizonReconstruction<PointNT>::performReconstruction(pcl::PolygonMesh& output) {
  makeHorizon();
  toPolygonMesh(result_.mesh, carried_, output);
}

template <typename PointNT>
void FaultedHorizonReconstruction<PointNT>::performReconstruction(pcl::PointCloud<PointNT>& points, std::vector<pcl::Vertices>& polygons) {
  makeHorizon();
  const TriangleMesh& mesh = result_.mesh;
  pcl::PointCloud<PointNT> made; // points may be the input itself
  if (carried_.data.empty())
    made.resize(mesh.vertices.size());
  else
    pcl::fromPCLPointCloud2(carried_, made);
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    made[v].getVector3fMap() = mesh.vertices[v].template cast<float>();
    if constexpr (pcl::traits::has_normal<PointNT>::value)
      made[v].getNormalVector3fMap() = mesh.normals[v].template cast<float>();
  }
  made.width = static_cast<std::uint32_t>(made.size());
  made.height = 1;
  made.is_dense = true;
  points = std::move(made);
  polygons.assign(mesh.triangles.size(), pcl::Vertices());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    polygons[t].vertices.assign(mesh.triangles[t].begin(), mesh.triangles[t].end());
}

template <typename PointNT>
std::vector<pcl::PolygonMesh> FaultedHorizonReconstruction<PointNT>::getPieces() const {
  std::vector<pcl::PolygonMesh> pieces = piecesOf(result_.mesh, carried_);
  for (pcl::PolygonMesh& piece : pieces)
    piece.header = piece.cloud.header = input_ ? input_->header : pcl::PCLHeader();
  return pieces;
}

} // namespace graben
GRABEN_EXPORT_END

#define PCL_INSTANTIATE_FaultedHorizonReconstruction(T) template class PCL_EXPORTS graben::FaultedHorizonReconstruction<T>;
