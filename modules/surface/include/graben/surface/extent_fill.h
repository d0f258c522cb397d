#pragma once

#include "graben/core/export.h"
#include "graben/surface/local_fit.h"
#include "graben/surface/map_outline.h"

GRABEN_EXPORT_BEGIN
namespace graben {

/// What a surface is to cover beyond the picks' surroundings.
struct ExtentFillOptions {
  MapOutline outline;      ///< to be covered whole; empty: none is
  double holes = 0.0;      ///< holes among the picks no wider than this on the map are covered, in the picks' units; infinity: all
  double reach = 0.0;      ///< what is farther than this from all picks is a hole, or beyond them: rho + delta
  double noise = 0.0;      ///< delta, largest noise of the picks
  double step = 0.0;       ///< mean distance of the picks; the places are as far apart
  unsigned threads = 0;    ///< 0: one per processor
};

/// Places that stand in for picks where there are none.
struct ExtentFill {
  Points places;  ///< on the surface carried on
  Points normals; ///< of the surface there, on the side of the picks' normals
  std::size_t holes = 0;   ///< covered
  double farthest = 0.0;   ///< of a place from the nearest pick
  std::size_t open = 0;    ///< holes left open for their width
  double widest_open = 0.0; ///< the widest of them
};

/// Carries the surface on from the picks over holes among them and out to an outline.
///
/// Ring by ring, each place a step from one of the last ring, on a polynomial fitted to the picks of its own side (a quadric where they lie all round, a plane
/// elsewhere) with a support three times as wide as the picks are far. Places do not cross any fault: each side is carried on to the fault by itself. A hole's
/// width is that of the widest circle that fits in. Nothing is found where all is within reach of picks. Deterministic for any number of threads. Cost: one
/// fit for each place and a map of cells half a step wide.
/// \param[in] fit of oriented picks; its search radius limits the supports
ExtentFill fillExtent(const LocalFit& fit, const ExtentFillOptions& options);

/// How far places within an outline lie from the nearest pick on the map, at most.
double farthestBeyondPicks(const Points& picks, const MapOutline& outline);

} // namespace graben
GRABEN_EXPORT_END
