#pragma once

#include "graben/core/export.h"
#include "graben/features/neighbor_grid.h"

GRABEN_EXPORT_BEGIN
namespace graben {

/// Mean distance from pick to pick where picks are, robust against dense patches and holes: the
/// square root of the area per pick, from the median of the discs that the nearest 8 cover. Picks
/// given several times count once. A voxel size that suits the cloud.
///
/// From about 20,000 picks spread over the grid's order; the same for any number of threads.
/// \param[in] threads 0: one per processor
/// \return in the picks' units; 0 if there are fewer than two distinct places
double meanPickDistance(const NeighborGrid& grid, unsigned threads = 0);

} // namespace graben
GRABEN_EXPORT_END
