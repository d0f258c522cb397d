#include "graben/mesh/triangle_bvh.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace graben {

namespace {

bool lexicographicallyBefore(const Vector3& a, const Vector3& b) {
  return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
}

/// Nearest point on the edge from corner i to corner j. Evaluated in an order that depends on the
/// ends alone, so that both triangles of a shared edge find the same point to the last bit.
TrianglePoint nearestOnEdge(const Vector3& p, const std::array<const Vector3*, 3>& corners, int i,
                            int j) {
  if (lexicographicallyBefore(*corners[j], *corners[i]))
    std::swap(i, j);
  const Vector3& a = *corners[i];
  const Vector3 along = *corners[j] - a;
  const double length2 = along.squaredNorm();
  const double t = length2 > 0.0 ? std::clamp((p - a).dot(along) / length2, 0.0, 1.0) : 0.0;
  TrianglePoint result;
  result.barycentric[i] = 1.0 - t;
  result.barycentric[j] = t;
  result.point = t == 1.0 ? *corners[j] : Vector3(a + t * along);
  return result;
}

/// For triangles too thin for their plane to mean anything.
TrianglePoint nearestOnOutline(const Vector3& p, const std::array<const Vector3*, 3>& corners) {
  TrianglePoint best = nearestOnEdge(p, corners, 0, 1);
  for (int e = 1; e < 3; ++e) {
    const TrianglePoint other = nearestOnEdge(p, corners, e, (e + 1) % 3);
    if ((other.point - p).squaredNorm() < (best.point - p).squaredNorm())
      best = other;
  }
  return best;
}

TrianglePoint corner(const std::array<const Vector3*, 3>& corners, int i) {
  TrianglePoint result;
  result.point = *corners[i];
  result.barycentric[i] = 1.0;
  return result;
}

} // namespace

TrianglePoint nearestPointOnTriangle(const Vector3& p, const Vector3& a, const Vector3& b,
                                     const Vector3& c) {
  constexpr double thin = 1e-10; // height over longest edge
  const std::array<const Vector3*, 3> corners{&a, &b, &c};
  const Vector3 ab = b - a;
  const Vector3 ac = c - a;
  const double longest2 = std::max({ab.squaredNorm(), ac.squaredNorm(), (c - b).squaredNorm()});
  if (!(ab.cross(ac).norm() > thin * longest2))
    return nearestOnOutline(p, corners);
  const Vector3 ap = p - a;
  const double d1 = ab.dot(ap);
  const double d2 = ac.dot(ap);
  if (d1 <= 0.0 && d2 <= 0.0)
    return corner(corners, 0);
  const Vector3 bp = p - b;
  const double d3 = ab.dot(bp);
  const double d4 = ac.dot(bp);
  if (d3 >= 0.0 && d4 <= d3)
    return corner(corners, 1);
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0)
    return nearestOnEdge(p, corners, 0, 1);
  const Vector3 cp = p - c;
  const double d5 = ab.dot(cp);
  const double d6 = ac.dot(cp);
  if (d6 >= 0.0 && d5 <= d6)
    return corner(corners, 2);
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0)
    return nearestOnEdge(p, corners, 2, 0);
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0)
    return nearestOnEdge(p, corners, 1, 2);
  const double sum = va + vb + vc;
  if (!(va >= 0.0 && vb >= 0.0 && vc >= 0.0 && sum > 0.0))
    return nearestOnOutline(p, corners);
  TrianglePoint result;
  const double v = vb / sum;
  const double w = vc / sum;
  result.barycentric = {std::max(0.0, 1.0 - v - w), v, w};
  result.point = a + v * ab + w * ac;
  return result;
}

} // namespace graben
