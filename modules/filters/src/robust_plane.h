#pragma once

#include "graben/core/types.h"

#include <vector>

namespace graben::detail {

/// A point a plane is fitted to.
struct WeightedPoint {
  Vector3 position;
  double weight;
};

/// Where a plane fitted to points around a query passes it.
struct PlaneAt {
  bool valid = false;
  Vector3 normal = Vector3::UnitZ(); ///< unit, sign arbitrary
  double offset = 0.0;               ///< of the query from the plane, along the normal
  double leverage = 0.0; ///< variance of the plane at the query over that of one point's noise
  double reach = 0.0;    ///< distance of the query to the points' weighted centre
};

/// Robust plane that outliers do not pull, up to about a third and as far off as the points spread:
/// from the best of planes through triples of points, by least absolute deviations, then Tukey's
/// biweight. Where no point is off by more than 2.5 \a scale there are no outliers, and least squares do. Deterministic.
/// \param[in] scale least standard deviation to reckon with, positive
/// \return not valid for fewer than 3 points, or points on a line
PlaneAt robustPlaneAt(const Vector3& query, const std::vector<WeightedPoint>& points, double scale);

} // namespace graben::detail
