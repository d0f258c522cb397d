#pragma once

#include "graben/surface/cut_mesh.h"
#include "unit/mesh/meshes.h"

namespace graben::test {

/// A flat square of n x n cells of size 1, two triangles each, on no fault.
inline CutMesh square(Index n) {
  CutMesh cut;
  cut.mesh = gridMesh(n);
  cut.vertex_faults.assign(cut.mesh.vertices.size(), {-1, -1});
  return cut;
}

} // namespace graben::test
