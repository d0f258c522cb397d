#pragma once

#include "graben/features/neighbor_grid.h"
#include "graben/surface/cut_mesh.h"

#include <vector>

namespace graben {

/// Triangles that stand out from their corners' normals and are turned by more than 80 degrees from the plane of the nearest pick, in rising order.
/// \param[in] cut      with vertex normals
/// \param[in] normals  of the grid's picks; those that are not finite say nothing
/// \param[in] reach    picks farther than this say nothing
/// \param[in] threads  0: one per processor
std::vector<Index> trianglesAgainstPicks(const CutMesh& cut, const NeighborGrid& grid, const Points& normals, double reach,
                                        unsigned threads = 0);

} // namespace graben
