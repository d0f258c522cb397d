#include "graben/mesh/bounds.h"

namespace graben {

Bounds boundsOf(const Points& points) {
  Bounds bounds;
  for (const Vector3& p : points)
    if (p.allFinite())
      bounds.extend(p);
  return bounds;
}

} // namespace graben
