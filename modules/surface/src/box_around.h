#pragma once

#include "graben/mesh/bounds.h"

namespace graben {

/// The cube with half edge \a radius about a place.
inline Bounds boxAround(const Vector3& p, double radius) {
  Bounds box;
  box.low = p.array() - radius;
  box.high = p.array() + radius;
  return box;
}

/// A box made larger on every side.
inline Bounds grown(Bounds box, double by) {
  box.low.array() -= by;
  box.high.array() += by;
  return box;
}

inline bool contains(const Bounds& box, const Vector3& p) { return (p.array() >= box.low.array()).all() && (p.array() <= box.high.array()).all(); }

} // namespace graben
