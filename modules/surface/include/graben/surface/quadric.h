#pragma once

#include "graben/core/export.h"
#include "graben/core/types.h"

GRABEN_EXPORT_BEGIN
namespace graben {

/// A quadric error metric (Garland and Heckbert 1997; the paper's section 4): the sum of squared distances to a set of planes, as the symmetric
/// matrix Q = [A b; b^T c], kept about a reference point so that nothing is lost at large coordinates.
class Quadric {
public:
  Quadric() = default;

  /// Adds the plane through \a point with unit \a normal, both relative to the reference point.
  void addPlane(const Vector3& point, const Vector3& normal, double weight = 1.0);

  Quadric& operator+=(const Quadric& other);

  /// Q(v): weighted sum of squared distances from \a v (relative to the reference point).
  double error(const Vector3& v) const;

  /// The step from the reference point that makes the error least. Directions whose eigenvalue is below \a relative_cutoff times the largest are
  /// undetermined and stay as they are: on a nearly flat horizon only the step across it is determined.
  /// \param[in] relative_cutoff 0 to 1, no unit
  Vector3 minimizer(double relative_cutoff) const;

private:
  Eigen::Matrix3d a_ = Eigen::Matrix3d::Zero();
  Vector3 b_ = Vector3::Zero();
  double c_ = 0.0;
};

} // namespace graben
GRABEN_EXPORT_END
