#include "places.h"
#include "random.h"

#include <functional>

namespace graben::synthetic {
namespace {

constexpr double kPi = 3.141592653589793;

/// The direction of an azimuth, exact for whole quarters of a turn.
Vector2 directionOf(double azimuth) {
  const double quarters = azimuth / 90.0;
  if (quarters != std::floor(quarters))
    return {std::sin(azimuth * kPi / 180.0), std::cos(azimuth * kPi / 180.0)};
  const auto quarter = static_cast<int>(quarters - 4.0 * std::floor(quarters / 4.0));
  constexpr int kSine[] = {0, 1, 0, -1};
  return {static_cast<double>(kSine[quarter]), static_cast<double>(kSine[(quarter + 1) % 4])};
}

std::size_t countOver(double extent, double distance) {
  return static_cast<std::size_t>(std::floor(extent / distance * (1.0 + 1e-12))) + 1;
}

} // namespace

LinePlaces::LinePlaces(const SyntheticSampling& sampling, double size, std::uint64_t seed)
    : sampling_(sampling)
    , half_(0.5 * size)
    , seed_(seed) {
  const double cross = sampling.cross_distance;
  if (sampling.kind == SyntheticSamplingKind::Grid) {
    families_[0] = family(sampling.azimuth, sampling.line_distance, cross > 0.0 ? cross : sampling.line_distance, size);
    return;
  }
  families_[0] = family(sampling.azimuth, sampling.line_distance, sampling.along, size);
  if (cross > 0.0)
    families_[1] = family(sampling.azimuth + 90.0, cross, sampling.along, size);
}

LinePlaces::Family LinePlaces::family(double azimuth, double distance, double step, double size) {
  Family f;
  f.along = directionOf(azimuth);
  f.across = Vector2(f.along.y(), -f.along.x());
  const double extent = size * (std::abs(f.along.x()) + std::abs(f.along.y())); // of the square seen along the lines or across them
  f.distance = distance;
  f.step = step;
  f.lines = countOver(extent, distance);
  f.steps = countOver(extent, step);
  return f;
}

Place LinePlaces::at(std::size_t i) const {
  const bool first = i < families_[0].places();
  const Family& f = families_[first ? 0 : 1];
  const std::size_t number = first ? i : i - families_[0].places();
  const std::size_t line = number / f.steps;
  const double out = (static_cast<double>(line) - 0.5 * static_cast<double>(f.lines - 1)) * f.distance;
  Vector2 xy = f.position(number % f.steps) * f.along + out * f.across;
  const double tolerance = 1e-9 * half_; // a place on the edge is inside
  for (double& c : {std::ref(xy.x()), std::ref(xy.y())})
    if (std::abs(c) > half_ && std::abs(c) <= half_ + tolerance)
      c = std::copysign(half_, c);
  return {xy, static_cast<Index>(first ? line : families_[0].lines + line)};
}

bool LinePlaces::isPicked(const Place& place, std::size_t i) const {
  if (!(sampling_.unpicked_share > 0.0))
    return true;
  const bool first = i < families_[0].places();
  const Family& f = families_[first ? 0 : 1];
  const double position = f.position((first ? i : i - families_[0].places()) % f.steps) + half_ * 2.0;
  RandomStream of_line(seed_ ^ 0x756e7069636b6564u, static_cast<std::uint64_t>(place.line));
  const auto stretch = static_cast<std::uint64_t>(position / sampling_.unpicked_length + of_line.uniform());
  RandomStream of_stretch(seed_ ^ 0x7374726574636865u, (static_cast<std::uint64_t>(place.line) << 32) + stretch);
  return of_stretch.uniform() >= sampling_.unpicked_share;
}

} // namespace graben::synthetic
