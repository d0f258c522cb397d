#pragma once

#include "support/horizon_options.h"
#include "support/takeaways.h"

namespace graben {

/// Writes what --output, --report and --results ask for, each whole or not at all.
/// \return sentences for the user: what a format could not hold, why pictures are missing
/// \throw WriteError that says what of it was written and what stands as it was
std::vector<std::string> writeOutputs(const OptionValues& values, const ReconstructionResult& result, const UnitNames& units);

} // namespace graben
