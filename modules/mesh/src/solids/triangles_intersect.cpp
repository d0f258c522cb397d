#include "graben/mesh/predicates.h"

#include <algorithm>
#include <cmath>

namespace graben {

namespace {

using Flat = Eigen::Vector2d;

/// The two axes a flat triangle is looked at along: those that leave it an area.
std::array<int, 2> planeAxes(const Vector3& a, const Vector3& b, const Vector3& c) {
  constexpr std::array<std::array<int, 2>, 3> kPairs = {{{0, 1}, {1, 2}, {2, 0}}};
  for (const auto& axes : kPairs) {
    const auto flat = [&axes](const Vector3& p) { return Flat(p[axes[0]], p[axes[1]]); };
    if (orientation(flat(a), flat(b), flat(c)) != 0)
      return axes;
  }
  return kPairs[0];
}

/// A triangle seen along an axis, counter-clockwise.
struct FlatTriangle {
  std::array<Flat, 3> p;

  FlatTriangle(const Points& points, const Triangle& t, const std::array<int, 2>& axes) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector3& q = points[static_cast<std::size_t>(t[i])];
      p[i] = Flat(q[axes[0]], q[axes[1]]);
    }
    if (orientation(p[0], p[1], p[2]) < 0)
      std::swap(p[1], p[2]);
  }
  bool contains(const Flat& q) const {
    return orientation(p[0], p[1], q) >= 0 && orientation(p[1], p[2], q) >= 0 && orientation(p[2], p[0], q) >= 0;
  }
};

bool betweenEnds(const Flat& a, const Flat& b, const Flat& p) {
  return std::min(a.x(), b.x()) <= p.x() && p.x() <= std::max(a.x(), b.x()) && std::min(a.y(), b.y()) <= p.y() && p.y() <= std::max(a.y(), b.y());
}

bool segmentsMeet(const Flat& a, const Flat& b, const Flat& c, const Flat& d) {
  const int ca = orientation(c, d, a), cb = orientation(c, d, b), ac = orientation(a, b, c), ad = orientation(a, b, d);
  if (ca * cb < 0 && ac * ad < 0)
    return true;
  return (ca == 0 && betweenEnds(c, d, a)) || (cb == 0 && betweenEnds(c, d, b)) || (ac == 0 && betweenEnds(a, b, c)) ||
         (ad == 0 && betweenEnds(a, b, d));
}

bool flatSegmentMeets(const FlatTriangle& t, const Flat& a, const Flat& b) {
  if (t.contains(a) || t.contains(b))
    return true;
  for (std::size_t i = 0; i < 3; ++i)
    if (segmentsMeet(a, b, t.p[i], t.p[(i + 1) % 3]))
      return true;
  return false;
}

/// Whether the closed segment has a point in common with the closed triangle.
bool segmentMeets(const Points& points, Index from, Index to, const Triangle& t) {
  const auto at = [&points](Index i) -> const Vector3& { return points[static_cast<std::size_t>(i)]; };
  const Vector3 &p = at(from), &q = at(to), &a = at(t[0]), &b = at(t[1]), &c = at(t[2]);
  const int sp = orientation(a, b, c, p), sq = orientation(a, b, c, q);
  if (sp * sq > 0)
    return false;
  if (sp == 0 && sq == 0) {
    const auto axes = planeAxes(a, b, c);
    return flatSegmentMeets(FlatTriangle(points, t, axes), Flat(p[axes[0]], p[axes[1]]), Flat(q[axes[0]], q[axes[1]]));
  }
  const int ab = orientation(p, q, a, b), bc = orientation(p, q, b, c), ca = orientation(p, q, c, a);
  return (ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0);
}

bool anyEdgeMeets(const Points& points, const Triangle& edges_of, const Triangle& t) {
  for (std::size_t i = 0; i < 3; ++i)
    if (segmentMeets(points, edges_of[i], edges_of[(i + 1) % 3], t))
      return true;
  return false;
}

/// The axes a triangle is seen largest along; any two where it has no area.
std::array<int, 2> widestAxes(const Vector3& a, const Vector3& b, const Vector3& c) {
  const Vector3 u = b - a, v = c - a;
  const double x = std::abs(u.y() * v.z() - u.z() * v.y()), y = std::abs(u.z() * v.x() - u.x() * v.z()), z = std::abs(u.x() * v.y() - u.y() * v.x());
  if (x >= y && x >= z)
    return {1, 2};
  return y >= z ? std::array<int, 2>{2, 0} : std::array<int, 2>{0, 1};
}

/// True if, seen along an axis, a line through an edge of the one parts it from all corners of the other that it does not share with that edge: then the
/// two meet in shared corners only, whatever is true in space. A quick look that settles nearly all neighbours in one plane.
bool partedByEdgeOf(const Points& points, const Triangle& edges_of, const Triangle& other, const std::array<int, 2>& axes) {
  const auto flat = [&](Index i) {
    const Vector3& p = points[static_cast<std::size_t>(i)];
    return Flat(p[axes[0]], p[axes[1]]);
  };
  for (std::size_t i = 0; i < 3; ++i) {
    const Index from = edges_of[i], to = edges_of[(i + 1) % 3];
    const int mine = orientation(flat(from), flat(to), flat(edges_of[(i + 2) % 3]));
    const auto is_beyond = [&](Index v) { return v == from || v == to || orientation(flat(from), flat(to), flat(v)) == -mine; };
    if (mine != 0 && std::all_of(other.begin(), other.end(), is_beyond))
      return true;
  }
  return false;
}

bool seenApart(const Points& points, const Triangle& a, const Triangle& b) {
  const auto at = [&points](Index i) -> const Vector3& { return points[static_cast<std::size_t>(i)]; };
  const auto axes = widestAxes(at(a[0]), at(a[1]), at(a[2]));
  return partedByEdgeOf(points, a, b, axes) || partedByEdgeOf(points, b, a, axes);
}

/// Turned so that its shared corners come first.
Triangle sharedFirst(const Triangle& t, const Triangle& other, std::size_t& shared) {
  Triangle turned;
  std::size_t front = 0, back = 3;
  for (const Index v : t)
    turned[std::find(other.begin(), other.end(), v) != other.end() ? front++ : --back] = v;
  shared = front;
  return turned;
}

/// The two triangles share an edge: they meet beyond it only if they lie in one plane, on the same side of it.
bool foldedOnEdge(const Points& points, const Triangle& a, Index apex) {
  const auto at = [&points](Index i) -> const Vector3& { return points[static_cast<std::size_t>(i)]; };
  if (orientation(at(a[0]), at(a[1]), at(a[2]), at(apex)) != 0)
    return false;
  const auto axes = planeAxes(at(a[0]), at(a[1]), at(a[2]));
  const auto flat = [&](Index i) { return Flat(at(i)[axes[0]], at(i)[axes[1]]); };
  return orientation(flat(a[0]), flat(a[1]), flat(a[2])) == orientation(flat(a[0]), flat(a[1]), flat(apex));
}

/// The two triangles share a corner, which comes first in both: they meet beyond it if the far edge of one meets the other, or if in one plane they overlap.
bool overlapAtCorner(const Points& points, const Triangle& a, const Triangle& b) {
  if (segmentMeets(points, a[1], a[2], b))
    return true;
  return segmentMeets(points, b[1], b[2], a);
}

} // namespace

bool trianglesIntersect(const Points& points, const Triangle& a, const Triangle& b) {
  std::size_t shared = 0;
  const Triangle mine = sharedFirst(a, b, shared);
  const Triangle other = sharedFirst(b, a, shared);
  if (shared == 3)
    return true;
  if (seenApart(points, a, b))
    return false;
  if (shared == 2)
    return foldedOnEdge(points, mine, other[2]);
  if (shared == 1)
    return overlapAtCorner(points, mine, other);
  return anyEdgeMeets(points, a, b) || anyEdgeMeets(points, b, a);
}

} // namespace graben
