#pragma once

#include "support/horizon_options.h"

namespace graben {

/// Refuses what cannot be written before the work starts: an unknown extension, a folder that is not there.
void checkOutputs(const OptionValues& values);

/// Writes what --output, --report and --results ask for.
/// \return sentences for the user: what a format could not hold, why pictures are missing
std::vector<std::string> writeOutputs(const OptionValues& values, const ReconstructionResult& result);

} // namespace graben
