#pragma once

#include "graben/faults/fault_lofting.h"

namespace graben::detail {

/// A fault that goes up and down from its trace everywhere in the same direction. \throw InvalidInputError if the dip is out of range or says not which way
FaultSurface faultFromTrace(const std::string& name, const FaultStick& trace, const TraceDip& dip, const Bounds& horizon);

} // namespace graben::detail
