#pragma once

#include "graben/core/types.h"

#include <algorithm>
#include <cmath>

namespace graben::synthetic {

using Vector2 = Eigen::Vector2d;

/// A fault surface q = level(s, z) with s along strike and q across, towards the dip, and the
/// displacement it causes.
///
/// The hanging wall is where q > level. Everything is analytic and unlimited; a tip ends the
/// displacement, not the surface.
class SyntheticFault {
public:
  Vector2 center = Vector2::Zero();
  Vector2 strike = Vector2::UnitY();
  Vector2 across = Vector2::UnitX(); ///< strike turned clockwise: the direction the fault dips to

  double cot_dip = 0.0;
  double bend = 0.0; ///< second derivative of level in z
  double wave_amplitude = 0.0;
  double wave_number = 0.0;

  double max_throw = 0.0;
  double throw_loss = 0.0; ///< share of the throw lost at |s| = throw_length
  double throw_length = 1.0;

  /// 0: the fault has no tip; +1: it ends at tip.x() and lies at smaller s; -1: at larger s.
  int tip_direction = 0;
  Vector2 tip = Vector2::Zero(); ///< s, q of the tip on the horizon
  double tip_length = 1.0;       ///< distance from the tip at which the throw is max_throw

  /// A fault that ends at another exists only on \a parent_side of it.
  int parent = -1;
  int parent_side = 0;

  void setStrike(double degrees_from_x);

  Vector2 toFault(const Vector2& xy) const {
    return {strike.dot(xy - center), across.dot(xy - center)};
  }
  Vector2 toMap(const Vector2& sq) const { return center + sq.x() * strike + sq.y() * across; }

  double level(double s, double z) const;

  /// Horizontal distance from the surface along \a across; positive in the hanging wall.
  double offset(const Vector2& xy, double z) const {
    const Vector2 sq = toFault(xy);
    return sq.y() - level(sq.x(), z);
  }

  /// First-order distance to the surface, and beyond a tip to the tip line.
  double distance(const Vector2& xy, double z) const;

  /// Signed distance along strike to the tip; positive beyond it, where there is no fault. Minus
  /// infinity without tip.
  double beyondTip(double s) const;

  /// Vertical displacement of the side -1 (footwall) or +1, and its gradient in x, y.
  double displacement(int side, const Vector2& xy) const;
  Vector2 displacementGradient(int side, const Vector2& xy) const;

private:
  struct Polar {
    double radius, angle;
  };
  Polar aboutTip(int side, const Vector2& sq) const;
};

} // namespace graben::synthetic
