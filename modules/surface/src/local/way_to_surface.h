#pragma once

#include "support_kernels.h"

#include <cmath>

namespace graben::detail {

constexpr double kExactEnough = 1e-3; ///< of the way to a surface
constexpr double kLeastRate = 0.1;    ///< below it a direction runs along a surface, not to it

/// A bound of a polynomial's second derivatives within its support: after one step along a direction (along_u, along_v) by an offset no more than
/// bend (along_u^2 + along_v^2) |offset| of the way is missing.
inline double bendOf(const double* c) {
  return std::abs(c[3]) + std::abs(c[4]) + std::abs(c[5]) + 3.0 * (std::abs(c[6]) + std::abs(c[7]) + std::abs(c[8]) + std::abs(c[9]));
}

/// From a place along a direction to a polynomial surface, by Newton's steps. Numbers are doubles, or Lanes for several surfaces at once.
///
/// Place and direction in the surface's frame: u and v over the radius of its support, and the height.
template <typename Number>
struct WayToSurface {
  Number at_u, at_v, height;
  Number along_u, along_v, along;
  Number offset = Number{}; ///< after a step: from the place along the direction to the surface
  Number slope_u, slope_v;  ///< of the surface where the step began
  Number rate;              ///< at which the direction comes nearer to the surface there

  [[gnu::always_inline]] void step(const Number* c) {
    const Number x = at_u + offset * along_u, y = at_v + offset * along_v;
    slope_u = c[1] + 2.0 * c[3] * x + c[4] * y + 3.0 * c[6] * x * x + 2.0 * c[7] * x * y + c[8] * y * y;
    slope_v = c[2] + c[4] * x + 2.0 * c[5] * y + c[7] * x * x + 2.0 * c[8] * x * y + 3.0 * c[9] * y * y;
    rate = along - slope_u * along_u - slope_v * along_v;
    Number fitted;
    heightOf(c, x, y, fitted);
    offset += (fitted - height - offset * along) / rate;
  }
};

} // namespace graben::detail
