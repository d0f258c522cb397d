#pragma once

#include "graben/core/types.h"
#include "planes/least_eigenvectors.h"
#include "planes/nearest_moments.h"

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
  SymmetricMatrix sum;   ///< of d d^T
  double farthest = 0.0; ///< squared distance of the farthest from the place the moments are about, or the first point

  Eigen::Matrix3d matrix() const; ///< the sum; only its lower triangle is set
};

/// \param[in] count of the points that the moments were taken of, one at the very place included
Scatter scatterOf(const Vector3& place, const Moments& moments, std::size_t count);

/// The same bits for any order of the indices after the first, of which the others must be different places.
Scatter scatterOf(const Points& points, const std::vector<Index>& indices);

/// The plane through the centroid whose normal n makes n^T (scatter + pull) n least; its direction is exact to a few units in the last place
/// where the points spread in two directions, nothing if they lie on a line and the pull does not help. \param[in] pull positive semidefinite,
/// lower triangle
std::optional<FittedPlane> fitPlane(const Scatter& scatter, const Eigen::Matrix3d& pull);
std::optional<FittedPlane> fitPlane(const Scatter& scatter);

/// The planes of many scatters without a pull, the same to the bit as one by one.
void fitPlanes(const Scatter* scatters, std::size_t count, std::optional<FittedPlane>* planes);

/// The plane of least squared distances to the points given by index; nothing if they are fewer than 3 or lie on a line.
std::optional<FittedPlane> fitPlane(const Points& points, const std::vector<Index>& indices);

} // namespace graben::detail
