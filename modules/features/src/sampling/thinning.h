#pragma once

#include "graben/core/types.h"

#include <vector>

namespace graben::detail {

/// A cloud of one point for each occupied cube of a lattice: the mean of the points in it.
struct ThinnedCloud {
  Points points;
  std::vector<Index> of; ///< for each point of the cloud it was made from the point it went into; -1 of one that is not finite
};

/// \param[in] size of the cubes, in the points' units
/// Points come in the order of their cubes along x, y and z. O(n log n)
ThinnedCloud thinned(const Points& points, double size);

} // namespace graben::detail
