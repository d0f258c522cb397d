#pragma once

#include "peer.h"

namespace graben::peer {

/// Joins vertices that share a cell of this size or lie in neighbouring cells within it, then leaves out triangles that lost an edge and
/// vertices without a triangle. Makes an indexed mesh of triangle soup.
void weldVertices(Mesh& mesh, double tolerance);

/// Leaves out triangles with a vertex farther than this from the nearest point, and the vertices that no triangle needs any more.
void trimFarTriangles(Mesh& mesh, const std::vector<Point>& points, double distance);

} // namespace graben::peer
