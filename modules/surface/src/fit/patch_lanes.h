#pragma once

#include "local/lanes.h"

namespace graben::detail {

/// Pieces of surface side by side, as places near them need them; where there are fewer, inverse_square is infinite.
struct PatchLanes {
  double centre[3][kLanes];          ///< of the picks
  double inverse_square[kLanes];     ///< 1 / square of the reach about it
  double origin[3][kLanes];          ///< of the frame
  double u[3][kLanes], v[3][kLanes]; ///< its axes over the radius of the support
  double normal[3][kLanes];
  double coefficients[10][kLanes]; ///< as LocalSurface has them
  double bend[kLanes];             ///< see bendOf()
};

/// How a place sees each of the surfaces.
struct PatchFeet {
  double weight[kLanes]; ///< falls smoothly from 1 to 0 at the reach; 0 also where the surface faces away or is not met
  double offset[kLanes]; ///< from the place along the direction to the surface
  double normal[3][kLanes]; ///< of the surface there, of any length, to the side of its plane's
};

/// \param[in] place        x, y, z
/// \param[in] direction    x, y, z of a unit vector
/// \param[in] least_cosine between the direction and a surface's plane
/// \return false if none reaches the place; the feet are not set then
bool findFeet(const PatchLanes& patches, const double* place, const double* direction, double least_cosine, PatchFeet& feet);

} // namespace graben::detail
