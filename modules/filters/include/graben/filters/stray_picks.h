#pragma once

#include "graben/core/export.h"
#include "graben/faults/fault_network.h"
#include "graben/features/neighbor_grid.h"

#include <vector>

GRABEN_EXPORT_BEGIN
namespace graben {

struct StrayOptions {
  double step = 0.0;       ///< picks no farther apart than this that no fault parts belong together, in the picks' units
  std::size_t fewest = 30; ///< picks that make a surface; groups of fewer are strays
  unsigned threads = 0;    ///< 0: one per processor
};

/// Finds picks near faults that are all alone on their side: groups of so few that they are strays, not a piece of horizon.
///
/// \param[in] among the picks to look at (their whole groups are looked at, as far as it takes), such as those near faults
/// \return those of them in small groups, in rising order. O(n) in the picks looked at; deterministic
std::vector<Index> strayPicks(const NeighborGrid& grid, const FaultNetwork& faults, const std::vector<Index>& among, const StrayOptions& options);

} // namespace graben
GRABEN_EXPORT_END
