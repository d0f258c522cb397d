#pragma once

#include "graben/analysis/evaluation.h"
#include "graben/core/local_frame.h"
#include "support/options.h"

#include <string>
#include <vector>

namespace graben {

/// What graben_evaluate reads: everything in one local frame, and what to tell the user.
struct EvaluationFiles {
  EvaluationInput input;
  LocalFrame frame;
  std::vector<std::string> cutoff_file; ///< of each cutoff line
  std::vector<std::string>
      notes; ///< sentences for the user: what was ignored, dropped or turned over
};

/// The options that name files and say how they are to be read.
void declareEvaluationInput(OptionParser& parser);

/// Reads the mesh (the positional) and all that it shall be measured against.
///
/// z grows as --z-positive says, else as the picks' file, else as the mesh's file says, else up.
/// Faults, truth and cutoff lines whose files say the opposite are turned over, with a note. \throw
/// IoError, ParseError, InvalidInputError
EvaluationFiles readEvaluationInput(const OptionValues& values);

} // namespace graben
