#pragma once

#include "support/horizon_options.h"

#include "graben/core/file_set.h"

namespace graben {

/// What the files of --results are told from others in the folder by.
const FileSetNames& resultsSet();

/// Refuses before the work starts, and before anything is read, what cannot be written: an unknown extension, a folder that is not there, a file that
/// may not be written, an output in the place of an input or of a file that is not from an earlier run.
/// \throw UsageError, WriteError
void checkHorizonOutputs(const OptionValues& values);

/// The same for the files of --results whose names depend on the faults.
void checkFaultResults(const OptionValues& values, const std::vector<FaultInput>& faults);

} // namespace graben
