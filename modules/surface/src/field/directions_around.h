#pragma once

#include "graben/core/types.h"

#include <cstdint>
#include <vector>

namespace graben {

/// Directions around a place, in a tangent plane: whether they close round it.
class DirectionsAround {
public:
  /// \param[in] normal of the plane, unit length
  explicit DirectionsAround(const Vector3& normal);

  void add(const Vector3& direction);
  bool empty() const { return directions_.empty(); }
  std::size_t size() const { return directions_.size(); }

  /// The direction at an angle.
  Vector3 at(double angle) const;

  /// True if all gaps between directions that follow each other are less than an angle, in radians; false if there is no direction.
  bool gapsBelow(double limit) const;

private:
  struct Direction {
    double u;
    double w;
    unsigned sector;
  };
  /// The extreme angles of the directions in a sector.
  struct Spread {
    double low;
    double high;
  };
  Spread spreadIn(unsigned sector) const;

  Vector3 u_;
  Vector3 w_;
  std::vector<Direction> directions_;
  std::uint64_t sectors_ = 0; ///< those that hold a direction
};

} // namespace graben
