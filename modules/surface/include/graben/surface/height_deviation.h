#pragma once

#include "graben/core/export.h"
#include "graben/surface/local_fit.h"

#include <vector>

GRABEN_EXPORT_BEGIN
namespace graben {

struct DeviationOptions {
  ModelChoice models;      ///< those the surface was fitted with
  double zone_width = 0.0; ///< the near model is used within half of this distance from a fault, as by refine()
  unsigned threads = 0;    ///< 0: one per processor
};

/// The standard deviation of a fitted surface across itself, at each of its vertices, in the picks' units; NaN where no pick is in reach.
///
/// Noise of the picks, as their left-out predictions show it, goes through the weights that the local fit gives them at a place: few picks, or picks on one
/// side only, pass more of it on, and the more so the farther the place is from them. Reckoned at the vertices on faults and at as many others as the supports
/// are wide, between which it is carried on. What a fault's own place is off by is not in it. Cost: one fit per such vertex; deterministic.
std::vector<float> heightDeviation(const CutMesh& cut, const VertexCorners& corners, const LocalFit& fit, const DeviationOptions& options);

} // namespace graben
GRABEN_EXPORT_END
