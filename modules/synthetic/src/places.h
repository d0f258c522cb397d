#pragma once

#include "structure.h"

#include "graben/synthetic/synthetic_sampling.h"

#include <array>
#include <cstdint>
#include <optional>

namespace graben::synthetic {

/// Where a pick may be taken.
struct Place {
  Vector2 xy = Vector2::Zero();
  Index line = -1;  ///< of the lines, rows or contours; -1: none
  Index sheet = -1; ///< the one to be picked there; -1: any
  std::optional<double> z = std::nullopt; ///< what the pick says, if not the horizon's
};

/// The places of samplings along lines and on grids, in order; those outside the area and in unpicked stretches among them.
class LinePlaces {
public:
  LinePlaces(const SyntheticSampling& sampling, double size, std::uint64_t seed);

  std::size_t count() const { return families_[0].places() + families_[1].places(); }
  Place at(std::size_t i) const;

  /// False in an unpicked stretch.
  bool isPicked(const Place& place, std::size_t i) const;

private:
  /// Parallel lines, symmetrical about the centre.
  struct Family {
    Vector2 along = Vector2::UnitY(), across = Vector2::UnitX();
    double distance = 1.0, step = 1.0;
    std::size_t lines = 0, steps = 0;
    std::size_t places() const { return lines * steps; }
    double position(std::size_t step_number) const { return (static_cast<double>(step_number) - 0.5 * static_cast<double>(steps - 1)) * step; }
  };
  static Family family(double azimuth, double distance, double step, double size);

  std::array<Family, 2> families_;
  SyntheticSampling sampling_;
  double half_ = 0.0;
  std::uint64_t seed_ = 0;
};

/// Places along the contours of all sheets, followed on a fine raster. O(raster nodes x sheets)
std::vector<Place> contourPlaces(const Structure& structure, const SyntheticSampling& sampling, unsigned threads);

} // namespace graben::synthetic
