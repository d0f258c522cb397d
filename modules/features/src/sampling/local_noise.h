#pragma once

#include "planes/plane_fit.h"

namespace graben::detail {

/// Variances of the noise about one pick, freed of the degrees of freedom the fits used; not finite
/// where there are too few neighbours.
struct LocalNoise {
  double about_plane;
  double about_quadric;
};

/// \param[in] origin    a point near the neighbours
/// \param[in] frame     columns: two tangents and the normal of the surface there
LocalNoise localNoise(const Points& points, const std::vector<Index>& neighbors,
                      const Vector3& origin, const Eigen::Matrix3d& frame);

/// An orthonormal right-handed frame whose third column is the unit vector given.
Eigen::Matrix3d frameAbout(const Vector3& normal);

} // namespace graben::detail
