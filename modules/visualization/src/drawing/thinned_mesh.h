#pragma once

#include "graben/mesh/triangle_mesh.h"

namespace graben {

/// A mesh of at most so many triangles that looks like another: vertices of a piece in a cell become one, cells as large as it takes. Normals are left out,
/// other fields are kept. For pictures: its borders are no longer those of the other. O(n log n), deterministic.
TriangleMesh thinnedMesh(const TriangleMesh& mesh, std::size_t most_triangles);

} // namespace graben
