#pragma once

#include "graben/core/export.h"
#include "graben/core/local_frame.h"
#include "graben/faults/fault_lofting.h"

#include <string>
#include <variant>
#include <vector>

GRABEN_EXPORT_BEGIN
namespace graben {

/// A fault as its file has it or as a program makes it, in the user's frame: a mesh, or sticks to be lofted.
struct FaultInput {
  std::string name; ///< from the file where it has one, else the file's name without extension
  std::variant<TriangleMesh, std::vector<FaultStick>> geometry = {};
  ZPositive z_positive = ZPositive::Unknown; ///< what the file says; Unknown: as the picks'
  std::string source = {};                   ///< path of the file; empty where there is none
  std::vector<std::string> notes = {};       ///< sentences for the user: what was ignored, dropped or assumed
  std::vector<std::string> warnings = {};    ///< sentences for the user: what is probably not as it was meant
};

/// The surfaces that a fault is, in a frame: sticks lofted, a mesh cleaned; turned over where the fault says that its z grows the other way than the frame's.
/// \throw InvalidInputError see loftFaults() and meshedFault()
LoftedFaults faultSurfaces(const FaultInput& fault, const LocalFrame& frame = {}, const LoftOptions& options = {});

} // namespace graben
GRABEN_EXPORT_END
