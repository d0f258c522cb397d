#pragma once

#include "graben/core/export.h"

#include <array>
#include <string>
#include <vector>

GRABEN_EXPORT_BEGIN
namespace graben {

/// How the picks of a synthetic horizon lie on the map.
enum class SyntheticSamplingKind {
  Scattered, ///< at random, SyntheticOptions::picks of them
  Grid,      ///< on the nodes of a grid
  Lines,     ///< along straight lines, one way or both
  Contours   ///< along the contours of a map: z is the contour's, the noise moves a pick on the map
};

/// The names of all samplings in the order of the enumeration, lower case.
const std::vector<std::string>& syntheticSamplingNames();

/// Where picks lie and what an interpreter, an autotracker or a gridder has done to them. Lengths in x, y units of the local frame. Lines and
/// grids lie symmetrically about the area's centre, so that the outermost lie on its edge where the distance divides its size.
struct SyntheticSampling {
  SyntheticSamplingKind kind = SyntheticSamplingKind::Scattered;
  double line_distance = 250.0; ///< between lines, between the rows of a grid; positive
  double cross_distance = 0.0;  ///< between the lines across these, 0: none; between the columns of a grid, 0: as between rows
  double along = 12.5;          ///< from pick to pick along a line or contour; positive
  double azimuth = 0.0;         ///< of the lines and rows, degrees clockwise from north (y)
  double contour_interval = 25.0; ///< positive
  /// No picks closer than this to where the footwall, the hanging wall meets a fault, on the map.
  std::array<double, 2> shadow{0.0, 0.0};
  /// Picks this close to a fault on the map, and all in its heave, lie on a straight ramp from one side to the other, as a gridder makes it.
  double bridge = 0.0;
  double mistie = 0.0;          ///< standard deviation of the constant by which a line is off; lines only
  double unpicked_share = 0.0;  ///< share of the lines that is left out in stretches, 0 to 0.9; lines only
  double unpicked_length = 0.0; ///< of such a stretch; positive where there are any
};

} // namespace graben
GRABEN_EXPORT_END
