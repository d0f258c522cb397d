#pragma once

#include "graben/synthetic/synthetic_model.h"
#include "support/options.h"

#include <string>
#include <vector>

namespace graben {

/// How a synthetic horizon is written.
struct SyntheticFolderOptions {
  std::string format = "xyz"; ///< of the picks: xyz, poi (the same rows), pcd or ply (binary double
                              ///< with the block as label)
  int decimals =
      3; ///< picks in text are rounded to this many; at most 9; other numbers are written in full
  bool truth = true;             ///< write truth meshes and cutoff lines
  double truth_resolution = 0.0; ///< see SyntheticModel::truthMeshes
  unsigned threads = 0;
  std::vector<SyntheticModel> deeper; ///< further horizons of a stack: their picks, and their truth in one mesh each
};

/// What was written.
struct SyntheticFolder {
  std::size_t picks = 0;
  std::vector<std::string> files; ///< without folder
};

/// Refuses, before anything is made, a folder that cannot be written to or that holds other files of these names.
/// \throw UsageError, WriteError
void checkSyntheticFolder(const OptionValues& values, std::size_t faults);

/// Writes picks, faults, truth, a README.txt that says what is what with the command to reconstruct
/// it, and synthetic.json with all options and files. The folder is made if it is not there; the
/// files of a former run in it are replaced all at once. \throw InvalidInputError, WriteError
SyntheticFolder writeSyntheticFolder(const SyntheticModel& model, const std::string& folder, const SyntheticFolderOptions& options);

} // namespace graben
