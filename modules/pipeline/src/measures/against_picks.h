#pragma once

#include "graben/features/neighbor_grid.h"
#include "graben/mesh/triangle_mesh.h"

#include <vector>

namespace graben {

/// Of the triangles named those that stand out from their corners' normals by more than 45 degrees and are turned by more than 80 degrees from the plane
/// of the nearest pick.
/// \param[in] mesh     with vertex normals
/// \param[in] normals  of the grid's picks; those that are not finite say nothing
/// \param[in] reach    picks farther than this say nothing
std::vector<Index> trianglesAgainstPicks(const TriangleMesh& mesh, const std::vector<Index>& suspects, const NeighborGrid& grid, const Points& normals,
                                        double reach);

} // namespace graben
