#pragma once

#include "graben/mesh/triangle_mesh.h"

namespace graben::detail {

/// The representative of every vertex: the first vertex within \a weld of it that represents itself
/// (0: with the same coordinates).
std::vector<Index> weldMap(const Points& vertices, double weld);

/// Joins vertices, drops triangles with a bad index, a corner that is not finite or no area, and
/// repeated triangles.
TriangleMesh cleanedMesh(const TriangleMesh& mesh, double weld);

/// Makes neighbours over manifold edges agree, then turns each patch so that its normals point up
/// on the whole; patches that stand upright agree with the others.
void orientUp(TriangleMesh& mesh);

} // namespace graben::detail
