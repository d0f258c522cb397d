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

/// Grows a box over places number \a first and those that follow, as long as its diagonal is no longer than \a most (the first is in it in any
/// case). \param[in] placeOf called with a number \return the number behind the last of them, \a end at most
template <typename PlaceOf>
std::size_t growOver(std::size_t first, std::size_t end, double most, const PlaceOf& placeOf, Bounds& box) {
  box = Bounds();
  for (std::size_t i = first; i < end; ++i) {
    Bounds more = box;
    more.extend(placeOf(i));
    if (i > first && more.diagonal() > most)
      return i;
    box = more;
  }
  return end;
}

inline bool contains(const Bounds& box, const Vector3& p) { return (p.array() >= box.low.array()).all() && (p.array() <= box.high.array()).all(); }

} // namespace graben
