#pragma once

#include "graben/pipeline/horizon_reconstruction.h"

namespace graben {

/// The options to make a surface once more, with the parameters a result used.
inline ReconstructionOptions withUsed(ReconstructionOptions options, const UsedParameters& used) {
  options.voxel_size = used.voxel_size;
  options.rho = used.rho;
  options.delta = used.delta;
  options.zone_width = used.zone_width;
  options.fault_reach = used.fault_reach;
  options.neighbors = used.neighbors;
  options.deviation = false;
  options.keep_picks = false;
  options.progress = nullptr;
  return options;
}

} // namespace graben
