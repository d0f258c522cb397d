#pragma once

#include "graben/core/export.h"
#include "graben/core/types.h"

#include <limits>

GRABEN_EXPORT_BEGIN
namespace graben {

/// Axis-aligned box; empty until extended.
struct Bounds {
  Vector3 low = Vector3::Constant(std::numeric_limits<double>::infinity());
  Vector3 high = Vector3::Constant(-std::numeric_limits<double>::infinity());

  bool empty() const { return !(low.x() <= high.x()); }
  void extend(const Vector3& p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  void extend(const Bounds& other) {
    low = low.cwiseMin(other.low);
    high = high.cwiseMax(other.high);
  }
  Vector3 size() const { return empty() ? Vector3(Vector3::Zero()) : Vector3(high - low); }
  double diagonal() const { return size().norm(); }
  bool overlaps(const Bounds& other) const {
    return (low.array() <= other.high.array()).all() && (other.low.array() <= high.array()).all();
  }
};

/// The box of the finite points. \param[in] threads 0: one per processor
Bounds boundsOf(const Points& points, unsigned threads = 0);

} // namespace graben
GRABEN_EXPORT_END
