#include "directions_around.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace graben {

namespace {

constexpr unsigned kSectors = 64;
constexpr double kWidestSector = 0.125; // radians, those between the axes

/// The sector of a direction, counted round from u, by a measure that grows with the angle and needs no arc tangent.
unsigned sectorOf(double u, double w) {
  const double sum = std::abs(u) + std::abs(w);
  if (!(sum > 0.0))
    return 0;
  const double quarter = w >= 0.0 ? (u >= 0.0 ? w / sum : 1.0 - u / sum) : (u < 0.0 ? 2.0 - w / sum : 3.0 + u / sum);
  return static_cast<unsigned>(quarter * (kSectors / 4)) % kSectors;
}

} // namespace

DirectionsAround::DirectionsAround(const Vector3& normal) : u_(normal.unitOrthogonal()), w_(normal.cross(u_)) {}

void DirectionsAround::add(const Vector3& direction) {
  const double u = direction.dot(u_);
  const double w = direction.dot(w_);
  directions_.push_back({u, w, sectorOf(u, w)});
  sectors_ |= std::uint64_t(1) << directions_.back().sector;
}

Vector3 DirectionsAround::at(double angle) const { return std::cos(angle) * u_ + std::sin(angle) * w_; }

DirectionsAround::Spread DirectionsAround::spreadIn(unsigned sector) const {
  Spread spread{4.0 * M_PI, 0.0};
  for (const Direction& d : directions_) {
    if (d.sector != sector)
      continue;
    double angle = std::atan2(d.w, d.u);
    angle += angle < 0.0 ? 2.0 * M_PI : 0.0;
    spread.low = std::min(spread.low, angle);
    spread.high = std::max(spread.high, angle);
  }
  return spread;
}

bool DirectionsAround::gapsBelow(double limit) const {
  if (empty())
    return false;
  const auto fewest = static_cast<int>(limit / kWidestSector) - 1; // empty sectors in a gap that wide
  unsigned before = kSectors - 1;
  while ((sectors_ >> before & 1U) == 0)
    --before;
  auto from = static_cast<int>(before) - static_cast<int>(kSectors);
  for (unsigned sector = 0; sector < kSectors; ++sector) {
    if ((sectors_ >> sector & 1U) == 0)
      continue;
    const int between = static_cast<int>(sector) - from - 1;
    if (between >= fewest) {
      const double gap = spreadIn(sector).low - spreadIn(before).high + (from < 0 ? 2.0 * M_PI : 0.0);
      if (gap >= limit)
        return false;
    }
    before = sector;
    from = static_cast<int>(sector);
  }
  return true;
}

} // namespace graben
