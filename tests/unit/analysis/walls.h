#pragma once

#include "graben/faults/fault_network.h"

#include <utility>

namespace graben::test {

/// A vertical fault in the plane x = \a x for y in [y0, y1] and z in [-10, 10].
inline FaultSurface wall(double x, double y0, double y1) {
  TriangleMesh mesh;
  mesh.vertices = {{x, y0, -10}, {x, y1, -10}, {x, y1, 10}, {x, y0, 10}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return FaultSurface::fromMesh("wall", mesh);
}

template <typename... Faults>
FaultNetwork network(Faults... faults) {
  return FaultNetwork(std::vector<FaultSurface>{std::move(faults)...});
}

} // namespace graben::test
