#pragma once

#include "graben/mesh/triangle_mesh.h"

namespace graben {

/// Twice the area of a triangle times its unit normal (zero for a degenerate one).
Vector3 areaNormal(const TriangleMesh& mesh, const Triangle& triangle);

/// Fills mesh.normals with angle-weighted vertex normals; (0,0,1) at a vertex without a proper
/// triangle.
void computeVertexNormals(TriangleMesh& mesh, unsigned threads = 0);

} // namespace graben
