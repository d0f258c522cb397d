#pragma once

#include "graben/core/types.h"

#include <algorithm>
#include <cmath>

namespace graben::detail {

/// A box in the units of a hierarchy's boxes, in single precision: holds the box it is made from whatever the rounding.
struct ScaledBox {
  std::array<float, 3> low, high;

  ScaledBox(const Vector3& low_corner, const Vector3& high_corner) {
    constexpr double kUnit = 2.4e-7; // two units in the last place of a float between 1 and 2
    constexpr double kFar = 1e15;    // mesh sizes from the mesh; farther boxes are moved there, which makes nothing farther
    for (int axis = 0; axis < 3; ++axis) {
      const double from = std::clamp(low_corner[axis], -kFar, kFar);
      const double to = std::clamp(high_corner[axis], -kFar, kFar);
      const double slack = kUnit * (1.0 + std::max(std::abs(from), std::abs(to)));
      low[static_cast<std::size_t>(axis)] = static_cast<float>(from - slack);
      high[static_cast<std::size_t>(axis)] = static_cast<float>(to + slack);
    }
  }

  /// Squared distances of the boxes of a node, which has arrays low and high of its children for each axis.
  template <typename Node>
  auto squaredDistances(const Node& node) const {
    using Boxes = Eigen::Array<float, sizeof(node.low[0]) / sizeof(float), 1>;
    Boxes sum = Boxes::Zero();
    for (std::size_t i = 0; i < 3; ++i)
      sum += (Boxes::MapAligned(node.low[i]) - high[i]).max(low[i] - Boxes::MapAligned(node.high[i])).max(0.0F).square();
    return sum;
  }
};

/// The largest squared distance of boxes in units of \a per_length to look at where what is within a distance is wanted.
inline float squaredReach(double distance, double per_length) {
  constexpr double kBeyondAll = 1e36;
  const double d = distance * per_length;
  return static_cast<float>(std::min(d * d * (1.0 + 1e-6) + 1e-37, kBeyondAll));
}

} // namespace graben::detail
