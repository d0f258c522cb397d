#pragma once

#include "graben/core/types.h"

#include <optional>

namespace graben::detail {

struct FittedPlane {
  Vector3 centre;
  Vector3 normal;
  double curvature; ///< smallest eigenvalue of the covariance over the sum of all
};

/// The plane of least squared distances to the points given by index, whose direction is exact to a
/// few units in the last place where the points spread in two directions; nothing if they are fewer
/// than 3 or lie on a line.
std::optional<FittedPlane> fitPlane(const Points& points, const std::vector<Index>& indices);

} // namespace graben::detail
