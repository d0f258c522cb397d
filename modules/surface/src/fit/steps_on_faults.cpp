#include "steps_on_faults.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace graben::detail {

Vector3 stepOnFaults(const FaultNetwork& faults, const std::array<Index, 2>& on, const Vector3& at, const Vector3& normal, double offset) {
  const Vector3 first = faults.nearest(static_cast<std::size_t>(on[0]), at).normal;
  Vector3 way = normal - normal.dot(first) * first;
  if (on[1] >= 0) {
    const Vector3 second = faults.nearest(static_cast<std::size_t>(on[1]), at).normal;
    const Vector3 line = first.cross(second);
    if (line.norm() > 0.05)
      way = line * (line.dot(normal) > 0.0 ? 1.0 : -1.0);
  }
  const double length = way.norm();
  if (length < 0.05)
    return Vector3::Zero();
  way /= length;
  return offset / std::max(way.dot(normal), 0.2) * way;
}

} // namespace graben::detail
