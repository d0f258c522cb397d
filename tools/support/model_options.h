#pragma once

#include "graben/io/fault_reader.h"
#include "graben/io/pick_set.h"
#include "graben/pipeline/model_reconstruction.h"
#include "support/options.h"

#include <string>
#include <vector>

namespace graben {

/// What graben_model reads.
struct ModelInput {
  std::vector<ModelHorizon> horizons;
  std::vector<FaultInput> faults;
  ModelOptions options;
  std::vector<std::string> notes;    ///< sentences for the user
  std::vector<std::string> warnings; ///< the same: what is probably not as it was meant
};

void declareModelOptions(OptionParser& parser);

/// \throw UsageError, IoError, ParseError, InvalidInputError (horizons whose z grow different ways)
ModelInput readModelInput(const OptionValues& values, const ProgressCallback& progress);

/// The picks of one horizon of a model, as read.
struct NamedPicks {
  std::string name;
  PickSet picks;
  HorizonRelation relation = HorizonRelation::Conformable;
};

/// The same of picks and faults that are read already, or come from no file. \throw UsageError, InvalidInputError
ModelInput joinModelInput(const OptionValues& values, std::vector<NamedPicks> horizons, std::vector<FaultInput> faults);

/// Refuses what cannot be written before the work starts.
void checkModelOutputs(const OptionValues& values);

} // namespace graben
