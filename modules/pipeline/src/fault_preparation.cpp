#include "fault_preparation.h"

#include "graben/core/errors.h"
#include "graben/faults/extension.h"

#include <algorithm>

namespace graben {

namespace {

/// The frame to read a fault in: its own z direction where its file says one, the picks' otherwise.
Vector3 toLocal(const Vector3& p, ZPositive z_positive, const LocalFrame& frame) {
  if (z_positive == ZPositive::Unknown || z_positive == frame.z_positive)
    return frame.toLocal(p);
  return frame.toLocal(Vector3(p.x(), p.y(), -p.z()));
}

FaultSurface localSurface(const FaultGeometry& fault, const LocalFrame& frame) {
  if (const auto* mesh = std::get_if<TriangleMesh>(&fault.geometry)) {
    TriangleMesh local;
    local.triangles = mesh->triangles;
    local.vertices.reserve(mesh->vertices.size());
    for (const Vector3& p : mesh->vertices)
      local.vertices.push_back(toLocal(p, fault.z_positive, frame));
    return FaultSurface::fromMesh(fault.name, local);
  }
  std::vector<FaultStick> sticks = std::get<std::vector<FaultStick>>(fault.geometry);
  for (FaultStick& stick : sticks)
    for (Vector3& p : stick.points)
      p = toLocal(p, fault.z_positive, frame);
  return FaultSurface::loft(fault.name, sticks);
}

} // namespace

std::vector<FaultSurface> prepareFaults(const std::vector<FaultGeometry>& faults, const LocalFrame& frame, double extension,
                                        std::vector<std::string>& warnings) {
  std::vector<FaultSurface> surfaces;
  for (const FaultGeometry& fault : faults) {
    if (fault.z_positive != ZPositive::Unknown && fault.z_positive != frame.z_positive)
      warnings.push_back("Fault " + fault.name + " has its z the other way up than the picks; it was turned over.");
    FaultSurface surface = localSurface(fault, frame);
    surfaces.push_back(extension > 0.0 ? extendedAlongDip(surface, extension) : std::move(surface));
  }
  return surfaces;
}

TriangleMesh toUserFrame(TriangleMesh local, const LocalFrame& frame) {
  for (Vector3& p : local.vertices)
    p = frame.toUser(p);
  for (Vector3& n : local.normals)
    n = frame.normalToUser(n);
  if (frame.mirrors())
    for (Triangle& t : local.triangles)
      std::swap(t[1], t[2]);
  return local;
}

FaultSurface toUserFrame(const FaultSurface& local, const LocalFrame& frame) {
  return {local.name, toUserFrame(local.mesh, frame)};
}

} // namespace graben
