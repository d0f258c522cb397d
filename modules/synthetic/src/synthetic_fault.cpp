#include "synthetic_fault.h"

#include <limits>

namespace graben::synthetic {
namespace {

constexpr double kPi = 3.141592653589793;

/// Throw profile of a crack: a square root at the tip, level at one length from it.
double profile(double rho) {
  return rho < 1.0 ? std::sqrt(rho * (2.0 - rho)) : 1.0;
}

double profileSlope(double rho) {
  return rho < 1.0 ? (1.0 - rho) / std::sqrt(rho * (2.0 - rho)) : 0.0;
}

} // namespace

void SyntheticFault::setStrike(double degrees_from_x) {
  const double angle = degrees_from_x * kPi / 180.0;
  strike = Vector2(std::cos(angle), std::sin(angle));
  across = Vector2(strike.y(), -strike.x());
}

double SyntheticFault::level(double s, double z) const {
  const double wave = wave_amplitude == 0.0 ? 0.0 : wave_amplitude * std::sin(wave_number * s);
  return wave - cot_dip * z + 0.5 * bend * z * z;
}

double SyntheticFault::beyondTip(double s) const {
  return tip_direction == 0 ? -std::numeric_limits<double>::infinity()
                            : (s - tip.x()) * tip_direction;
}

double SyntheticFault::distance(const Vector2& xy, double z) const {
  const Vector2 sq = toFault(xy);
  const double slope_s = wave_amplitude * wave_number * std::cos(wave_number * sq.x());
  const double slope_z = -cot_dip + bend * z;
  const double across_fault =
      (sq.y() - level(sq.x(), z)) / std::sqrt(1.0 + slope_s * slope_s + slope_z * slope_z);
  return std::hypot(across_fault, std::max(0.0, beyondTip(sq.x())));
}

SyntheticFault::Polar SyntheticFault::aboutTip(int side, const Vector2& sq) const {
  const double along = beyondTip(sq.x());
  const double out = sq.y() - tip.y();
  double angle = std::atan2(out, along);
  // Each side has its own branch of the angle, so that its displacement goes on smoothly past the
  // fault.
  if (side < 0 && angle > 0.5 * kPi)
    angle -= 2.0 * kPi;
  else if (side > 0 && angle < -0.5 * kPi)
    angle += 2.0 * kPi;
  return {std::hypot(along, out), angle};
}

double SyntheticFault::displacement(int side, const Vector2& xy) const {
  if (side == 0)
    return 0.0;
  const Vector2 sq = toFault(xy);
  if (tip_direction == 0) {
    const double loss = 0.5 - 0.5 * std::cos(kPi * sq.x() / throw_length);
    return -0.5 * side * max_throw * (1.0 - throw_loss * loss);
  }
  const Polar p = aboutTip(side, sq);
  return -0.5 * max_throw * profile(p.radius / tip_length) * std::sin(0.5 * p.angle);
}

Vector2 SyntheticFault::displacementGradient(int side, const Vector2& xy) const {
  if (side == 0)
    return Vector2::Zero();
  const Vector2 sq = toFault(xy);
  if (tip_direction == 0) {
    const double k = kPi / throw_length;
    return 0.25 * side * max_throw * throw_loss * k * std::sin(k * sq.x()) * strike;
  }
  const Polar p = aboutTip(side, sq);
  if (p.radius == 0.0)
    return Vector2::Zero();
  const double rho = p.radius / tip_length;
  const double radial = profileSlope(rho) / tip_length * std::sin(0.5 * p.angle);
  const double around = 0.5 * profile(rho) * std::cos(0.5 * p.angle) / p.radius;
  const double along = radial * std::cos(p.angle) - around * std::sin(p.angle);
  const double out = radial * std::sin(p.angle) + around * std::cos(p.angle);
  return -0.5 * max_throw * (along * tip_direction * strike + out * across);
}

} // namespace graben::synthetic
