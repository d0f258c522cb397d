#pragma once

#include "graben/pipeline/model_reconstruction.h"
#include "support/options.h"

#include <string>
#include <vector>

namespace graben {

/// What graben_model reads.
struct ModelInput {
  std::vector<ModelHorizon> horizons;
  std::vector<FaultGeometry> faults;
  ModelOptions options;
  std::vector<std::string> notes;    ///< sentences for the user
  std::vector<std::string> warnings; ///< the same: what is probably not as it was meant
};

void declareModelOptions(OptionParser& parser);

/// \throw UsageError, IoError, ParseError, InvalidInputError (horizons whose z grow different ways)
ModelInput readModelInput(const OptionValues& values, const ProgressCallback& progress);

/// Refuses what cannot be written before the work starts.
void checkModelOutputs(const OptionValues& values);

} // namespace graben
