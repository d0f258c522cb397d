#pragma once

#include "graben/mesh/bounds.h"
#include "graben/pipeline/horizon_reconstruction.h"

namespace graben {

/// \param[in] picks box of the picks in the local frame
/// \throw InvalidInputError if a length given by the user is longer than the cloud, in which no surface is found by it
void checkLengths(const ReconstructionOptions& options, const Bounds& picks);

/// What became of the picks on the way to a surface without triangles.
struct NoSurface {
  const ReconstructionReport& report;
  std::size_t picks_left = 0; ///< that took part
  std::size_t at_faults = 0;  ///< within the clearance of a fault
  double spacing = 0.0;       ///< their mean distance
  bool cut = false;           ///< there were triangles before the faults cut them
};

/// \throw InvalidInputError that names the likeliest cause, always
[[noreturn]] void refuseEmptySurface(const NoSurface& what);

/// A warning where the flip angle left out much of the surface; empty where it did not.
std::string warnOfFlipAngle(const ReconstructionReport& report, std::size_t triangles);

} // namespace graben
