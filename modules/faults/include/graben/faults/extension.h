#pragma once

#include "graben/core/export.h"
#include "graben/faults/fault_surface.h"

#include <functional>

GRABEN_EXPORT_BEGIN
namespace graben {

/// The fault continued up and down by \a distance along its local dip, for faults whose sticks stop
/// above or below a horizon.
///
/// Only borders that face up or down dip are extended, to the full width of the fault: its lateral
/// tip lines simply go on, its length along strike stays as it is, and holes stay open. Existing
/// vertices and triangles keep their places in the mesh; new ones follow. Tip lines go on too. New
/// triangles are wound as the border they continue and none is degenerate; where a border is folded
/// so much that its strips would overlap, a triangle is left out. Deterministic; O(b^2) for b
/// border vertices. \param[in] fault    a consistently oriented fault \param[in] distance in the
/// fault's units; 0 returns the fault as it is \throw InvalidInputError if distance is negative or
/// not finite, or the fault's mesh is not valid
FaultSurface extendedAlongDip(const FaultSurface& fault, double distance);

/// Where an upper or lower border of a fault is to be continued: for each of its points.
/// \param[in] border  its points, in its order
/// \param[in] outward for each of them the unit direction along dip, away from the fault
using WhereExtended = std::function<std::vector<bool>(const Points& border, const Points& outward)>;

/// The same where \a where says so only.
FaultSurface extendedAlongDip(const FaultSurface& fault, double distance, const WhereExtended& where);

/// Whether a fault goes on beyond one of its lateral ends.
/// \param[in] end     the vertices along the end, in the border's order
/// \param[in] outward for each of them the unit direction along strike, away from the fault
using GoesOn = std::function<bool(const Points& end, const Points& outward)>;

/// The fault continued along strike by \a distance at those lateral ends that \a goes_on accepts, for faults that were drawn no
/// farther than the data reach: such an end is no tip. Tip lines there move out with it. Otherwise as extendedAlongDip.
FaultSurface extendedAlongStrike(const FaultSurface& fault, double distance, const GoesOn& goes_on);

} // namespace graben
GRABEN_EXPORT_END
