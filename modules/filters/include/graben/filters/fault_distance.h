#pragma once

#include "graben/core/export.h"
#include "graben/faults/fault_network.h"

#include <vector>

GRABEN_EXPORT_BEGIN
namespace graben {

/// A point near a fault.
struct PickNearFault {
  Index pick;
  double distance; ///< to the nearest fault
};

/// The points within \a limit of a fault, in the order they are looked at.
///
/// Blocks of points that no fault comes near cost next to nothing if neighbours follow each other.
/// Parallel, the same for any number of threads.
/// \param[in] limit   in the points' units, not negative
/// \param[in] order   the points to look at, in an order that keeps neighbours together; null: all
/// \throw InvalidInputError if the limit is negative or NaN
std::vector<PickNearFault> picksNearFaults(const Points& points, const FaultNetwork& faults, double limit,
                                           const std::vector<Index>* order = nullptr, unsigned threads = 0);

/// The same points without their distances, which saves most of the time: blocks that lie wholly within the limit are taken as they are.
std::vector<Index> picksWithin(const Points& points, const FaultNetwork& faults, double limit, unsigned threads = 0);

/// Distance of each point to the nearest fault; infinite where that is more than \a limit or the
/// point is not finite.
/// \throw InvalidInputError if the limit is negative or NaN
std::vector<double> distancesToFaults(const Points& points, const FaultNetwork& faults, double limit, unsigned threads = 0);

} // namespace graben
GRABEN_EXPORT_END
