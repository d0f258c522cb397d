#pragma once

#include "graben/faults/fault_surface.h"

namespace graben::detail {

/// Without points that are not finite or repeat one of the stick, top first as far as that can be
/// told from the stick alone. Does not depend on the direction in which the stick was given. Empty
/// if fewer than two points are left.
FaultStick cleanedStick(const FaultStick& stick, bool& reversed);

double length(const FaultStick& stick);

/// True if \a a comes before \a b in the order of their coordinates.
bool before(const FaultStick& a, const FaultStick& b);

/// The order of cleaned sticks in an open shortest path; depends on their geometry alone, not on
/// the order given, as long as the sticks come sorted by before().
std::vector<std::size_t> shortestPath(const std::vector<FaultStick>& sticks);

} // namespace graben::detail
