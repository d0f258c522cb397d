#pragma once

#include "graben/core/export.h"
#include "graben/surface/local_fit.h"

#include <vector>

GRABEN_EXPORT_BEGIN
namespace graben {

/// Lengths are in the picks' units; 0 stands for the estimate named.
struct FaultShadowOptions {
  double mean_distance = 0.0; ///< from pick to pick
  double limit = 0.0;         ///< picks that stop farther than this before a fault are not carried on; 0: a sixth of the cloud's diagonal
  unsigned threads = 0;       ///< 0: one per processor
};

/// How far picks stop before a fault on one of its sides.
struct FaultShadow {
  Index fault = -1;
  int side = 0;            ///< +1: of the hanging wall (where the fault's normal points to), -1: of the footwall
  double width = 0.0;      ///< median along strike where they do
  double widest = 0.0;     ///< 90 % of it is not wider
  double share = 0.0;      ///< of the length along strike where they do
  std::size_t carried = 0; ///< places added there
};

/// The surface across the strips beside faults in which an autotracker has left no picks.
struct FaultShadowFill {
  Points places;  ///< on the surface carried on from the last picks to the fault, a mean distance apart
  Points normals; ///< of the surface there, on the side of the picks' normals
  std::vector<FaultShadow> shadows; ///< those found, by fault and side
  LocalModel model;    ///< what the surface was carried on with: its degree
  double support = 0.0; ///< and the radius of its support, in widths of the shadow
};

/// Measures how far picks stop before each fault, on both sides and along strike, and carries the surface on to the fault.
///
/// A shadow is a stretch along strike, eight mean distances long, beside which no pick lies within 2.5 mean distances of the fault but some farther off, on a
/// side whose other side has picks too. From each pick at its edge, with no other before it, places follow towards the fault (beyond its tip, towards the
/// tip) on a polynomial fitted to the picks of the own side within a few shadow widths. Its degree and support are those that best predict picks left out in
/// strips as wide as the shadow. Places do not cross any fault. Nothing is found where picks reach the faults, at the cost of a look at the picks near them
/// and at some others. Deterministic for any number of threads.
/// \param[in] fit of oriented picks; its search radius should reach four limits
FaultShadowFill fillFaultShadows(const LocalFit& fit, const FaultShadowOptions& options);

} // namespace graben
GRABEN_EXPORT_END
