#pragma once

#include "graben/core/types.h"

#include <vector>

namespace graben {

/// True if a line rises or falls from its first point to its last by more than a share of its way on the map.
bool isSteep(const Points& line, double share);

/// The sticks of a list of points that nothing parts: each begins where z turns back.
/// \returns nothing unless all of them go steeply the same way
std::vector<Points> sticksOfTurns(const Points& list);

/// True if a list of points runs to and fro, as sticks one after another do, and not along one
/// line.
bool runsToAndFro(const Points& list);

} // namespace graben
