#include "structure.h"

#include "roots.h"

#include <limits>

namespace graben::synthetic {
namespace {

struct Sine {
  double amplitude, kx, ky,
      phase; ///< amplitude as a share of the relief, wave numbers in waves per size
};
constexpr Sine kSines[] = {{0.5, 1.15, 0.25, 0.4}, {0.3, -0.35, 1.4, 1.9}, {0.2, 1.3, 1.5, 4.1}};
constexpr double kTwoPi = 6.283185307179586;

} // namespace

double Structure::base(const Vector2& xy) const {
  const double k = kTwoPi / size;
  double z = 0.0;
  for (const Sine& sine : kSines)
    z += sine.amplitude * std::sin(k * (sine.kx * xy.x() + sine.ky * xy.y()) + sine.phase);
  return relief * z + tilt.dot(xy) - lowered;
}

Vector2 Structure::baseGradient(const Vector2& xy) const {
  const double k = kTwoPi / size;
  Vector2 gradient = Vector2::Zero();
  for (const Sine& sine : kSines)
    gradient += sine.amplitude * std::cos(k * (sine.kx * xy.x() + sine.ky * xy.y()) + sine.phase) *
                Vector2(k * sine.kx, k * sine.ky);
  return relief * gradient + tilt;
}

double Structure::height(const Sheet& sheet, const Vector2& xy) const {
  double z = base(xy);
  for (std::size_t i = 0; i < faults.size(); ++i)
    z += faults[i].displacement(sheet.side[i], xy);
  return z;
}

Vector2 Structure::heightGradient(const Sheet& sheet, const Vector2& xy) const {
  Vector2 gradient = baseGradient(xy);
  for (std::size_t i = 0; i < faults.size(); ++i)
    gradient += faults[i].displacementGradient(sheet.side[i], xy);
  return gradient;
}

double Structure::inside(const Sheet& sheet, const Vector2& xy, int except) const {
  double least = std::numeric_limits<double>::infinity();
  const double z = height(sheet, xy);
  for (std::size_t i = 0; i < faults.size(); ++i)
    if (sheet.side[i] != 0 && static_cast<int>(i) != except)
      least = std::min(least, sheet.side[i] * faults[i].offset(xy, z));
  return least;
}

double Structure::cutoff(const Sheet& sheet, std::size_t fault, double s) const {
  const SyntheticFault& f = faults[fault];
  double z_range = relief + size * tilt.norm() + std::abs(lowered);
  for (const SyntheticFault& other : faults)
    z_range += std::abs(other.max_throw);
  const double reach = std::abs(f.cot_dip) * z_range + std::abs(f.bend) * z_range * z_range + 1.0;
  const double middle = f.level(s, 0.0);
  const auto offset = [&](double q) {
    const Vector2 xy = f.toMap({s, q});
    return f.offset(xy, height(sheet, xy));
  };
  return findRoot(offset, middle - reach, middle + reach);
}

std::pair<double, double> Structure::strikeRange(std::size_t fault) const {
  const SyntheticFault& f = faults[fault];
  std::pair<double, double> range(std::numeric_limits<double>::infinity(),
                                  -std::numeric_limits<double>::infinity());
  constexpr int kSteps = 400;
  for (int k = 0; k <= kSteps; ++k) {
    const double s = size * (2.0 * k / kSteps - 1.0);
    if (f.beyondTip(s) > 0.0)
      continue;
    for (const Sheet& sheet : sheets) {
      if (!bounds(sheet, fault))
        continue;
      const Vector2 xy = f.toMap({s, cutoff(sheet, fault, s)});
      if (inArea(xy) && inside(sheet, xy, static_cast<int>(fault)) >= 0.0)
        range = {std::min(range.first, s), std::max(range.second, s)};
    }
  }
  if (f.tip_direction > 0)
    range.second = f.tip.x();
  if (f.tip_direction < 0)
    range.first = f.tip.x();
  return range;
}

} // namespace graben::synthetic
