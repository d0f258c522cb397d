#pragma once

#include "graben/core/export.h"
#include "graben/surface/local_fit.h"

#include <vector>

GRABEN_EXPORT_BEGIN
namespace graben {

struct FaultRampOptions {
  double mean_distance = 0.0; ///< from pick to pick, in their units
  double noise = 0.0;         ///< standard deviation of the picks, in their units
  unsigned threads = 0;       ///< 0: one per processor
};

/// Picks that turn towards the other side of a fault just before it.
struct FaultRamp {
  Index fault = -1;
  double width = 0.0; ///< how far from the fault they do, in the picks' units, the wider of its two sides
  double height = 0.0; ///< by how much, both sides together
};

/// Finds faults through which the picks run as a ramp: a gridder has bridged them, or a tracker was smeared along them (or beds are dragged).
///
/// On each side of a fault, at places along it, a parabola through the picks 5 to 14 mean distances away is carried on to the fault. On a ramp the picks next
/// to the fault lie off it towards the other side, on both sides; a fault is named where that is so at most places, by more than noise and bends explain and
/// by a fifth of the step at least. Deterministic for any number of threads. Cost: a few supports of some 600 picks for each fault.
/// \param[in] fit of oriented picks
std::vector<FaultRamp> findFaultRamps(const LocalFit& fit, const FaultRampOptions& options);

} // namespace graben
GRABEN_EXPORT_END
