#pragma once

#include "graben/mesh/adjacency.h"

#include <array>
#include <vector>

namespace graben {

/// The edges that only one triangle has, each in the direction of its triangle, in the triangles'
/// order.
std::vector<std::array<Index, 2>> borderEdges(const TriangleMesh& mesh, unsigned threads = 0);
std::vector<std::array<Index, 2>> borderEdges(const TriangleMesh& mesh, const EdgeAdjacency& adjacency);

/// The border as a mesh of triangles without width, so that a TriangleBvh finds the nearest border
/// point.
TriangleMesh borderMesh(const TriangleMesh& mesh, unsigned threads = 0);

} // namespace graben
