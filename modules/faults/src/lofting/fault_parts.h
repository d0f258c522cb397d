#pragma once

#include "graben/faults/fault_surface.h"

namespace graben::detail {

/// The sticks of each fault among those of one file: faults beside each other that were drawn on the same sections, and faults apart from each other. All in
/// one where nothing tells them apart.
std::vector<std::vector<FaultStick>> toldApart(const std::vector<FaultStick>& sticks);

} // namespace graben::detail
