#include "graben/surface/fault_mesh_processing.h"

#include "carried_mesh.h"

#include "graben/core/errors.h"
#include "graben/mesh/normals.h"

#include <pcl/console/print.h>

#include <cmath>

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

void FaultMeshProcessing::process(pcl::PolygonMesh& output) {
  pcl::PolygonMesh result;
  if (input_mesh_)
    pcl::MeshProcessing::process(result);
  else
    fail("The input mesh is missing.", result);
  output = std::move(result);
}

void FaultMeshProcessing::performProcessing(pcl::PolygonMesh& output) {
  status_ = SurfaceStatus::NotRun;
  message_.clear();
  vertex_faults_.clear();
  try {
    if (!std::isfinite(tolerance_) || tolerance_ < 0.0)
      throw InvalidInputError(
          "options", "The tolerance must be positive, or 0 to take a share of the median edge.");
    CarriedMesh carried(*input_mesh_);
    TriangleMesh mesh = carried.takeMesh();
    if (mesh.empty())
      throw InvalidInputError("reading a mesh", "The input mesh has no triangle.");
    CutMesh result = processMesh(std::move(mesh));
    computeVertexNormals(result.mesh, threads_);
    carried.write(result.mesh, output);
    vertex_faults_ = std::move(result.vertex_faults);
    status_ = SurfaceStatus::Complete;
  } catch (const std::bad_alloc&) {
    fail("There is not enough memory.", output);
  } catch (const std::exception& error) {
    fail(error.what(), output);
  }
}

} // namespace graben
