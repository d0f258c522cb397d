#pragma once

#include "graben/faults/fault_network.h"

#include <array>

namespace graben::detail {

/// The step within the faults a vertex lies on that lifts it by \a offset along \a normal.
Vector3 stepOnFaults(const FaultNetwork& faults, const std::array<Index, 2>& on, const Vector3& at, const Vector3& normal, double offset);

} // namespace graben::detail
