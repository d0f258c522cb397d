#pragma once

#include "graben/faults/fault_surface.h"

namespace graben::detail {

/// True if a line comes back to where it started around an area, as a polygon on a map does.
bool isRing(const FaultStick& stick);

/// A node that was set aside.
struct Flyer {
  std::size_t stick, node; ///< places in what was given
  double distance = 0.0;   ///< to where the nodes around it would have it
};

/// Takes out the few nodes that lie far off what all others around them say.
std::vector<Flyer> removeFlyers(std::vector<FaultStick>& sticks);

/// Puts nodes that run to and fro in order along their stick. \return false if they were in order
bool orderNodes(FaultStick& stick);

} // namespace graben::detail
