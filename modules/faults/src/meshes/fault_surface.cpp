#include "graben/faults/fault_surface.h"

#include "meshes/cleaning.h"

#include "graben/core/errors.h"

#include <cmath>

namespace graben {

FaultSurface FaultSurface::fromMesh(std::string name, const TriangleMesh& mesh, double weld) {
  if (!std::isfinite(weld) || weld < 0.0)
    throw InvalidInputError("building fault " + name,
                            "The weld distance must be zero or positive.");
  FaultSurface fault{std::move(name), detail::cleanedMesh(mesh, weld), {}};
  if (fault.mesh.empty())
    throw InvalidInputError(
        "building fault " + fault.name,
        "No triangle with three distinct finite corners is left. Check the fault's file.");
  detail::orientUp(fault.mesh);
  return fault;
}

} // namespace graben
