#pragma once

#include "graben/io/fault_reader.h"
#include "graben/io/pick_reader.h"
#include "graben/pipeline/horizon_reconstruction.h"
#include "support/options.h"

namespace graben {

/// What a command that reconstructs reads from files.
struct HorizonInput {
  PickSet picks;
  std::vector<FaultInput> faults;
  std::vector<DipMeasurement> dips;
  std::vector<std::string> notes;    ///< sentences for the user: what was ignored, dropped or assumed
  std::vector<std::string> warnings; ///< sentences for the user: what is probably not as it was meant
};

/// The options of a reconstruction: --horizon, --fault and every parameter of ReconstructionOptions.
void declareHorizonOptions(OptionParser& parser);

/// --columns and --null, for commands that read picks.
void declareTableOptions(OptionParser& parser);

/// What they say.
ReadOptions readOptions(const OptionValues& values, const ProgressCallback& progress = {});

/// The parameters alone, for commands with an input of their own.
/// \param[in] with_extension false: --extend-faults is declared by the caller
void declareParameterOptions(OptionParser& parser, bool with_extension = true);

HorizonInput readHorizonInput(const OptionValues& values, const ProgressCallback& progress = {});

/// The same of picks and faults that are read already, or come from no file; dips are left to the caller.
/// \throw InvalidInputError if picks and faults cannot be of one frame
HorizonInput joinHorizonInput(const OptionValues& values, PickSet picks, std::vector<FaultInput> faults);

/// \param[in] values   a parsed command line
/// \param[in] z_positive what the picks' file says
ReconstructionOptions reconstructionOptions(const OptionValues& values, ZPositive z_positive);

} // namespace graben
