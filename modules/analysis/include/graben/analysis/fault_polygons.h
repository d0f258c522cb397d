#pragma once

#include "graben/analysis/fault_throw.h"
#include "graben/core/export.h"

#include <vector>

GRABEN_EXPORT_BEGIN
namespace graben {

/// The area in the map between a fault's two cutoffs.
struct FaultPolygon {
  Index fault = -1;
  bool overlap = false; ///< false: a gap, where a normal fault has taken the horizon away; true: the horizon lies over itself, at a reverse fault
  Points ring;          ///< counter-clockwise seen from above, the first point not repeated; z is that of the cutoffs
  double area = 0.0;    ///< in the map
};

struct FaultPolygonOptions {
  double least_area = 0.0; ///< smaller polygons are left out; in x, y units squared, 0 or more
};

/// The fault polygons of a horizon, from the samples of its faults.
///
/// A fault gives one polygon for each run of samples without a gap; where it turns from normal to reverse the polygon ends and one of the other kind begins.
/// At a tip the polygon closes. No two polygons overlap: of what two faults would both claim, at a junction, the one named first keeps it.
/// \param[in] throws for each fault its samples in order along strike, as readThrows() gives them; z up
/// In the order of the faults; O(n log n) for faults that do not cover each other, deterministic, thread-safe.
std::vector<FaultPolygon> faultPolygons(const std::vector<std::vector<ThrowSample>>& throws, const FaultPolygonOptions& options = {});

} // namespace graben
GRABEN_EXPORT_END
