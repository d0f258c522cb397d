#include "graben/faults/fault_input.h"

namespace graben {

namespace {

/// In the fault's own z direction where its file says one, the frame's otherwise.
Vector3 toLocal(const Vector3& p, ZPositive z_positive, const LocalFrame& frame) {
  const ZPositive frames = frame.z_positive == ZPositive::Unknown ? ZPositive::Up : frame.z_positive;
  if (z_positive == ZPositive::Unknown || z_positive == frames)
    return frame.toLocal(p);
  return frame.toLocal(Vector3(p.x(), p.y(), -p.z()));
}

} // namespace

LoftedFaults faultSurfaces(const FaultInput& fault, const LocalFrame& frame, const LoftOptions& options) {
  if (const auto* mesh = std::get_if<TriangleMesh>(&fault.geometry)) {
    TriangleMesh local;
    local.triangles = mesh->triangles;
    local.vertices.reserve(mesh->vertices.size());
    for (const Vector3& p : mesh->vertices)
      local.vertices.push_back(toLocal(p, fault.z_positive, frame));
    return meshedFault(fault.name, local, options);
  }
  std::vector<FaultStick> sticks = std::get<std::vector<FaultStick>>(fault.geometry);
  for (FaultStick& stick : sticks)
    for (Vector3& p : stick.points)
      p = toLocal(p, fault.z_positive, frame);
  return loftFaults(fault.name, sticks, options);
}

} // namespace graben
