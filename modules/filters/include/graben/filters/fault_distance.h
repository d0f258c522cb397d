#pragma once

#include "graben/faults/fault_network.h"

#include <vector>

namespace graben {

/// Distance of each point to the nearest fault; infinite where that is more than \a limit or the
/// point is not finite.
///
/// Blocks of points that no fault comes near cost next to nothing if neighbours follow each other.
/// Parallel, the same for any number of threads.
/// \param[in] limit   in the points' units, not negative
/// \param[in] order   the points asked for, in an order that keeps neighbours together; each gets
/// its entry of the result, the others are infinite. Null: all
/// \throw InvalidInputError if the limit is negative or NaN
std::vector<double> distancesToFaults(const Points& points, const FaultNetwork& faults,
                                      double limit, const std::vector<Index>* order = nullptr,
                                      unsigned threads = 0);

} // namespace graben
