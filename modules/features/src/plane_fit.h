#pragma once

#include "graben/core/types.h"

#include <optional>

namespace graben::detail {

struct FittedPlane {
  Vector3 centre;
  Vector3 normal;
  double curvature; ///< smallest eigenvalue of the covariance over the sum of all
};

/// How points spread about their centroid.
struct Scatter {
  Vector3 centre = Vector3::Zero();
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero(); ///< of d d^T; only the lower triangle is set
  double farthest = 0.0;                         ///< squared distance of the farthest from the first
};

Scatter scatterOf(const Points& points, const std::vector<Index>& indices);

/// The plane through the centroid whose normal n makes n^T (scatter + pull) n least; its direction is exact to a few units in the last place
/// where the points spread in two directions, nothing if they lie on a line and the pull does not help. \param[in] pull positive semidefinite,
/// lower triangle; null: none
std::optional<FittedPlane> fitPlane(const Scatter& scatter, const Eigen::Matrix3d* pull = nullptr);

/// The plane of least squared distances to the points given by index; nothing if they are fewer than 3 or lie on a line.
std::optional<FittedPlane> fitPlane(const Points& points, const std::vector<Index>& indices);

} // namespace graben::detail
