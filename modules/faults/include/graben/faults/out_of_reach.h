#pragma once

#include "graben/core/export.h"
#include "graben/faults/fault_network.h"

GRABEN_EXPORT_BEGIN
namespace graben {

/// What to tell a user whose faults have no effect on his data.
/// \param[in] data box of the points or the mesh \param[in] what the data are, in a word for the user: "points", "mesh"
/// \return a sentence that says how far away they are; empty where there is no fault
std::string faultsWithoutEffect(const FaultNetwork& faults, const Bounds& data, const std::string& what);

/// The same where it is certain beforehand: all faults lie farther from the data than they reach, as in another frame.
/// \param[in] reach in the faults' units
/// \return empty where a fault may be within reach. O(log faults)
std::string faultsOutOfReach(const FaultNetwork& faults, const Bounds& data, double reach, const std::string& what);

} // namespace graben
GRABEN_EXPORT_END
