#pragma once

#include "graben/core/types.h"

namespace graben {

/// Leaves out, by NaN, points that are exactly where an earlier one is: a place counts once, however often a file names it. O(n); 8 bytes a point.
/// \return how many
std::size_t dropRepeated(Points& points);

} // namespace graben
