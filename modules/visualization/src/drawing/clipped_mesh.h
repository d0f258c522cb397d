#pragma once

#include "graben/mesh/bounds.h"
#include "graben/mesh/triangle_mesh.h"

namespace graben {

/// What of a mesh lies in a box, cut off there; without normals and labels. Faults reach far over and under a horizon.
TriangleMesh clippedMesh(const TriangleMesh& mesh, const Bounds& box);

/// The box of the vertices that triangles use, and some room around it.
Bounds boxAroundSurface(const TriangleMesh& surface);

} // namespace graben
