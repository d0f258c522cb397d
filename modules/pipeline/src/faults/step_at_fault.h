#pragma once

#include "graben/features/neighbor_grid.h"

namespace graben {

/// What the picks say of a place where a fault may be continued.
enum class StepVerdict {
  Unknown, ///< too few picks on either side, or the horizon passes elsewhere: beyond the continuation, or through the fault as it is
  Step,    ///< the horizon passes there and its two sides disagree by more than their noise, or it is hardly farther than a pick's distance
  Whole    ///< it passes there in one
};

struct StepAtFault {
  StepVerdict verdict = StepVerdict::Unknown;
  double length = 0.0; ///< from the fault's border to the horizon, the farther side
};

/// A border of a fault and how far it may be continued.
struct BorderPlace {
  Vector3 border, outward, strike; ///< a place on it, and unit directions: the way it would be continued, and along it
  double reach = 0.0;
  double pick_distance = 0.0;
};

/// Looks at the horizon on both sides of a fault's continuation. O(picks near it)
StepAtFault stepAtFault(const NeighborGrid& picks, const BorderPlace& place);

} // namespace graben
