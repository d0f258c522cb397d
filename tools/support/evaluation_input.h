#pragma once

#include "graben/analysis/evaluation.h"
#include "graben/core/local_frame.h"
#include "graben/io/fault_reader.h"
#include "graben/io/mesh_reader.h"
#include "graben/io/pick_set.h"
#include "support/options.h"

#include <string>
#include <vector>

namespace graben {

/// What graben_evaluate reads: everything in one local frame, and what to tell the user.
struct EvaluationFiles {
  EvaluationInput input;
  LocalFrame frame;
  std::vector<std::string> cutoff_file; ///< of each cutoff line
  std::vector<std::string> notes;       ///< sentences for the user: what was ignored, dropped or turned over
  std::vector<std::string> warnings;    ///< sentences for the user: what is probably not as it was meant
};

/// The options that name files and say how they are to be read.
void declareEvaluationInput(OptionParser& parser);

/// The options that say how it is to be measured, and what they say.
void declareMeasuring(OptionParser& parser);
EvaluationOptions evaluationOptions(const OptionValues& values);

/// Reads the mesh (the positional) and all that it shall be measured against.
///
/// z grows as --z-positive says, else as the picks' file, else as the mesh's file says, else up.
/// Faults, truth and cutoff lines whose files say the opposite are turned over, with a note. \throw
/// IoError, ParseError, InvalidInputError
EvaluationFiles readEvaluationInput(const OptionValues& values);

/// A part of the true surface, and what it is called in messages.
struct TruthPart {
  std::string source;
  MeshInput mesh;
};

/// What a surface is measured against, as read: each in its own frame.
struct EvaluationParts {
  std::vector<MeshInput> mesh; ///< at least one
  PickSet picks;
  std::vector<FaultInput> faults;
  std::vector<TruthPart> truth;
  std::vector<FaultInput> cutoffs; ///< polylines
};

/// The same of parts that are read already, or come from no file. \throw UsageError, InvalidInputError
EvaluationFiles joinEvaluation(const OptionValues& values, const EvaluationParts& parts);

} // namespace graben
