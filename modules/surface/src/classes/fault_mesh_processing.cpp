#include "graben/surface/fault_mesh_processing.h"

#include "carried_mesh.h"

#include "graben/core/errors.h"
#include "graben/faults/out_of_reach.h"
#include "graben/mesh/median_edge.h"
#include "graben/mesh/normals.h"

#include <pcl/console/print.h>

#include <algorithm>
#include <cmath>
#include <new>

namespace graben {

const FaultNetwork& FaultMeshProcessing::faults() const {
  static const FaultNetwork none;
  return faults_ ? *faults_ : none;
}

void FaultMeshProcessing::fail(const std::string& message, pcl::PolygonMesh& output) {
  status_ = SurfaceStatus::Failed;
  message_ = message;
  vertex_faults_.clear();
  const pcl::PCLHeader header = output.header;
  output = pcl::PolygonMesh();
  output.header = output.cloud.header = header;
  PCL_ERROR("[graben::%s::process] %s\n", getClassName().c_str(), message.c_str());
}

void FaultMeshProcessing::warn(const std::string& message) {
  if (message.empty())
    return;
  message_ += (message_.empty() ? "" : " ") + message;
  PCL_WARN("[graben::%s::process] %s\n", getClassName().c_str(), message.c_str());
}

void FaultMeshProcessing::process(pcl::PolygonMesh& output) {
  status_ = SurfaceStatus::NotRun;
  message_.clear();
  vertex_faults_.clear();
  used_tolerance_ = 0.0;
  pcl::PolygonMesh result;
  try {
    if (!input_mesh_)
      throw InvalidInputError("reading a mesh", "The input mesh is missing.");
    pcl::MeshProcessing::process(result);
  } catch (const std::bad_alloc&) {
    fail("There is not enough memory.", result);
  } catch (const std::exception& error) {
    fail(error.what(), result);
  }
  output = std::move(result);
}

void FaultMeshProcessing::performProcessing(pcl::PolygonMesh& output) {
  try {
    run(output);
    status_ = SurfaceStatus::Complete;
  } catch (const std::bad_alloc&) {
    fail("There is not enough memory.", output);
  } catch (const std::exception& error) {
    fail(error.what(), output);
  }
}

void FaultMeshProcessing::run(pcl::PolygonMesh& output) {
  constexpr double kShareOfEdge = 0.02;
  if (!std::isfinite(tolerance_) || tolerance_ < 0.0)
    throw InvalidInputError("options", "The tolerance must be positive, or 0 to take a share of the median edge.");
  CarriedMesh carried(*input_mesh_);
  TriangleMesh mesh = carried.takeMesh();
  if (mesh.empty())
    throw InvalidInputError("reading a mesh", "The input mesh has no triangle.");
  used_tolerance_ = tolerance_ > 0.0 ? tolerance_ : kShareOfEdge * medianEdge(mesh);
  CutMesh result = processMesh(std::move(mesh), used_tolerance_);
  if (std::none_of(result.vertex_faults.begin(), result.vertex_faults.end(), [](const std::array<Index, 2>& f) { return f[0] >= 0; }))
    warn(faultsWithoutEffect(faults(), boundsOf(result.mesh.vertices), "mesh"));
  computeVertexNormals(result.mesh, threads_);
  carried.write(result.mesh, output);
  vertex_faults_ = std::move(result.vertex_faults);
}

} // namespace graben
