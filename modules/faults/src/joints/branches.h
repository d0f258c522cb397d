#pragma once

#include "graben/faults/fault_network.h"

namespace graben::detail {

/// Joins every fault that ends at another to it, as FaultNetwork documents; all against the faults
/// as they were given.
std::vector<FaultBranch> joinBranches(std::vector<FaultSurface>& faults, double reach);

} // namespace graben::detail
