#pragma once

#include "graben/core/export.h"
#include "graben/faults/fault_network.h"
#include "graben/features/pick_layout.h"

GRABEN_EXPORT_BEGIN
namespace graben {

/// A cloud in which no direction outvotes another: where picks lie along lines, one point stands for those of a short stretch of line.
struct BalancedPicks {
  Points points;
  std::vector<Index> of;            ///< for each pick the point that it is part of; -1 of a pick that is not finite
  std::vector<std::uint32_t> picks; ///< for each point how many picks it is the mean of
};

/// Picks on lines become the means of those within about an eighth of the line distance, so that along the lines there is a point each quarter of the line
/// distance; picks that lie dense in all directions stay as they are, and none is joined across a fault.
///
/// The means have less noise than the picks by the root of their number. Points come in the order of the grid. The same for any number of threads.
/// O(n log n) \param[in] layout of the grid's points. \param[in] faults may be empty. \param[in] threads 0: one per processor
BalancedPicks balancedPicks(const NeighborGrid& grid, const PickLayout& layout, const FaultNetwork& faults, unsigned threads = 0);

} // namespace graben
GRABEN_EXPORT_END
