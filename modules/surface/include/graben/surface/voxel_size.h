#pragma once

#include "graben/features/neighbor_grid.h"

namespace graben {

/// A voxel size that suits a cloud: its median distance from pick to pick where picks are dense,
/// from the area that the eight nearest cover; in the picks' units.
///
/// Takes up to 20,000 picks evenly through the grid's order; the same result for any number of
/// threads. \param[in] threads 0: one per processor \return 0 if there are no two distinct picks
double estimateVoxelSize(const NeighborGrid& grid, unsigned threads = 0);

} // namespace graben
