#include "graben/mesh/triangle_bvh.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace graben {

namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::size_t kStackSize = 128; ///< the hierarchy is less than 100 deep

using Corners = std::array<Vector3, 3>;

struct StackEntry {
  std::size_t node;
  double key; ///< lower bound of what can be found below the node
};

double squaredDistance(const Bounds& box, const Vector3& p) {
  return (box.low - p).cwiseMax(p - box.high).cwiseMax(0.0).squaredNorm();
}

/// A segment made ready for many tests.
struct SegmentQuery {
  Vector3 a, b, d, inverse;
  double
      tolerance; ///< distance within which something is on the segment's end or a triangle's edge
  double length;

  SegmentQuery(const Vector3& from, const Vector3& to, double scale)
      : a(from)
      , b(to)
      , d(to - from)
      , inverse(d.cwiseInverse()) {
    tolerance =
        8.0 * kEpsilon * std::max({scale, a.cwiseAbs().maxCoeff(), b.cwiseAbs().maxCoeff()});
    length = d.norm();
  }

  /// Where the segment enters a box grown by twice the tolerance; infinity if it misses.
  double entry(const Bounds& box) const {
    double t0 = 0.0;
    double t1 = 1.0;
    for (int axis = 0; axis < 3; ++axis) {
      const double low = box.low[axis] - 2.0 * tolerance;
      const double high = box.high[axis] + 2.0 * tolerance;
      if (!std::isfinite(inverse[axis])) {
        if (a[axis] < low || a[axis] > high)
          return kInfinity;
        continue;
      }
      const double u = (low - a[axis]) * inverse[axis];
      const double v = (high - a[axis]) * inverse[axis];
      t0 = std::max(t0, std::min(u, v));
      t1 = std::min(t1, std::max(u, v));
    }
    return t0 <= t1 ? t0 : kInfinity;
  }
};

int signBeyond(double value, double limit) {
  return value > limit ? 1 : (value < -limit ? -1 : 0);
}

/// Where a segment meets one triangle.
struct TriangleHit {
  double parameter = 0.0;
  unsigned on_edges = 0; ///< bit e: on edge e, within tolerance
};

/// Signed volumes decide, each against a bound on its own rounding error; what is in doubt counts
/// as touching. So of the two triangles at an edge at least one is hit, whichever way the rounding
/// went.
bool meets(const SegmentQuery& s, const Corners& c, TriangleHit& hit) {
  const Vector3 e1 = c[1] - c[0];
  const Vector3 e2 = c[2] - c[0];
  const Vector3 n = e1.cross(e2);
  const double n_length = n.norm();
  if (!(n_length > 0.0))
    return false;
  const Vector3 from_a = s.a - c[0];
  const Vector3 from_b = s.b - c[0];
  const double va = n.dot(from_a);
  const double vb = n.dot(from_b);
  const double n_error = 4.0 * kEpsilon * e1.norm() * e2.norm();
  const int side_a = signBeyond(va, s.tolerance * n_length + n_error * from_a.norm());
  const int side_b = signBeyond(vb, s.tolerance * n_length + n_error * from_b.norm());
  if (side_a == side_b)
    return false;
  const int direction = side_a != 0 ? -side_a : side_b;
  hit.on_edges = 0;
  for (unsigned e = 0; e < 3; ++e) {
    const Vector3 edge = c[(e + 1) % 3] - c[e];
    const double volume = direction * edge.dot(s.d.cross(c[e] - s.a));
    const double limit = s.tolerance * s.length * edge.norm();
    if (volume < -limit)
      return false;
    if (volume <= limit)
      hit.on_edges |= 1U << e;
  }
  hit.parameter = side_a == 0 ? 0.0 : (side_b == 0 ? 1.0 : std::clamp(va / (va - vb), 0.0, 1.0));
  return true;
}

Vector3 pointAt(const Vector3& a, const Vector3& b, double parameter) {
  return parameter == 1.0 ? b : Vector3(a + parameter * (b - a));
}

/// A hit with the corners that span the edge or corner it lies on.
struct EdgeHit {
  SegmentHit hit;
  std::array<const Vector3*, 2>
      ends{}; ///< null: inside the triangle; twice the same: on that corner

  EdgeHit(const SegmentHit& h, const Corners& c, unsigned on_edges)
      : hit(h) {
    for (unsigned e = 0; e < 3; ++e) {
      const bool here = (on_edges & (1U << e)) != 0;
      const bool before = (on_edges & (1U << ((e + 2) % 3))) != 0;
      if (here && before) {
        ends = {&c[e], &c[e]};
        return;
      }
      if (here)
        ends = {&c[e], &c[(e + 1) % 3]};
    }
  }
  bool onOutline() const { return ends[0] != nullptr; }
};

/// True if both hits are the same passage through a shared edge or corner.
bool samePassage(const EdgeHit& p, const EdgeHit& q, double tolerance) {
  const bool same_way = *p.ends[0] == *q.ends[0] && *p.ends[1] == *q.ends[1];
  const bool opposite = *p.ends[0] == *q.ends[1] && *p.ends[1] == *q.ends[0];
  if (same_way || opposite)
    return true;
  for (const Vector3* i : p.ends)
    for (const Vector3* j : q.ends)
      if (*i == *j && (p.hit.point - *i).norm() <= tolerance &&
          (q.hit.point - *i).norm() <= tolerance)
        return true;
  return false;
}

/// Leaves the lowest triangle of every passage through a shared edge or corner.
std::vector<SegmentHit> mergePassages(const std::vector<EdgeHit>& found, double tolerance) {
  std::vector<SegmentHit> result;
  std::vector<std::pair<std::size_t, const EdgeHit*>> outline; // place in result, hit
  for (const EdgeHit& next : found) {
    if (!next.onOutline()) {
      result.push_back(next.hit);
      continue;
    }
    const auto same = std::find_if(outline.begin(), outline.end(), [&](const auto& earlier) {
      return samePassage(*earlier.second, next, tolerance);
    });
    if (same == outline.end()) {
      outline.emplace_back(result.size(), &next);
      result.push_back(next.hit);
    } else {
      outline.emplace_back(same->first, &next);
    }
  }
  return result;
}

} // namespace

const Bounds& TriangleBvh::bounds() const {
  static const Bounds nothing;
  return nodes_.empty() ? nothing : nodes_.front().bounds;
}

MeshPoint TriangleBvh::nearest(const Vector3& p, double max_distance) const {
  MeshPoint best;
  if (empty() || !p.allFinite() || !(max_distance >= 0.0))
    return best;
  // Boxes are passed over only where they are farther than the best by more than rounding, so that
  // ties are seen.
  const double rounding = 8.0 * kEpsilon * std::max(scale_, p.cwiseAbs().maxCoeff());
  const auto reach = [rounding](double distance) {
    return (distance + rounding) * (distance + rounding);
  };
  double best2 = max_distance * max_distance;
  double limit = reach(max_distance);
  std::array<StackEntry, kStackSize> stack; // NOLINT: filled as far as it is read
  std::size_t size = 0;
  stack[size++] = {0, squaredDistance(bounds(), p)};
  while (size > 0) {
    const StackEntry top = stack[--size];
    if (top.key > limit)
      continue;
    const Node& node = nodes_[top.node];
    if (node.count == 0) {
      StackEntry near{top.node + 1, squaredDistance(nodes_[top.node + 1].bounds, p)};
      StackEntry far{static_cast<std::size_t>(node.right),
                     squaredDistance(nodes_[static_cast<std::size_t>(node.right)].bounds, p)};
      if (far.key < near.key)
        std::swap(near, far);
      if (far.key <= limit)
        stack[size++] = far;
      if (near.key <= limit)
        stack[size++] = near;
      continue;
    }
    for (auto i = static_cast<std::size_t>(node.first),
              end = i + static_cast<std::size_t>(node.count);
         i < end; ++i) {
      const TrianglePoint found =
          nearestPointOnTriangle(p, corners_[i][0], corners_[i][1], corners_[i][2]);
      const double d2 = (found.point - p).squaredNorm();
      const bool better =
          d2 < best2 || (d2 == best2 && (best.triangle < 0 || order_[i] < best.triangle));
      if (!better)
        continue;
      best2 = d2;
      best = {order_[i], found.point, found.barycentric, std::sqrt(d2)};
      limit = reach(best.distance);
    }
  }
  return best;
}

template <typename OnHit>
void TriangleBvh::walkSegment(const Vector3& a, const Vector3& b, const OnHit& on_hit) const {
  if (empty() || !a.allFinite() || !b.allFinite())
    return;
  const SegmentQuery segment(a, b, scale_);
  double limit = 1.0;                       // on_hit lowers it; below 0 ends the walk
  std::array<StackEntry, kStackSize> stack; // NOLINT: filled as far as it is read
  std::size_t size = 0;
  stack[size++] = {0, segment.entry(bounds())};
  while (size > 0) {
    const StackEntry top = stack[--size];
    if (top.key > limit)
      continue;
    const Node& node = nodes_[top.node];
    if (node.count == 0) {
      StackEntry near{top.node + 1, segment.entry(nodes_[top.node + 1].bounds)};
      StackEntry far{static_cast<std::size_t>(node.right),
                     segment.entry(nodes_[static_cast<std::size_t>(node.right)].bounds)};
      if (far.key < near.key)
        std::swap(near, far);
      if (far.key <= limit)
        stack[size++] = far;
      if (near.key <= limit)
        stack[size++] = near;
      continue;
    }
    TriangleHit hit;
    for (auto i = static_cast<std::size_t>(node.first),
              end = i + static_cast<std::size_t>(node.count);
         i < end; ++i)
      if (meets(segment, corners_[i], hit))
        limit = on_hit(i, hit.parameter, hit.on_edges);
  }
}

std::optional<SegmentHit> TriangleBvh::firstHit(const Vector3& a, const Vector3& b) const {
  SegmentHit best;
  best.parameter = 1.0;
  walkSegment(a, b, [&](std::size_t i, double parameter, unsigned) {
    if (best.triangle < 0 || parameter < best.parameter ||
        (parameter == best.parameter && order_[i] < best.triangle))
      best = {order_[i], parameter, pointAt(a, b, parameter)};
    return best.parameter;
  });
  return best.triangle < 0 ? std::nullopt : std::optional<SegmentHit>(best);
}

std::vector<SegmentHit> TriangleBvh::allHits(const Vector3& a, const Vector3& b) const {
  std::vector<EdgeHit> found;
  walkSegment(a, b, [&](std::size_t i, double parameter, unsigned on_edges) {
    found.emplace_back(SegmentHit{order_[i], parameter, pointAt(a, b, parameter)}, corners_[i],
                       on_edges);
    return 1.0;
  });
  std::sort(found.begin(), found.end(),
            [](const EdgeHit& p, const EdgeHit& q) { return p.hit.triangle < q.hit.triangle; });
  const double tolerance = found.empty() ? 0.0 : 64.0 * SegmentQuery(a, b, scale_).tolerance;
  std::vector<SegmentHit> result = mergePassages(found, tolerance);
  std::sort(result.begin(), result.end(), [](const SegmentHit& p, const SegmentHit& q) {
    return p.parameter != q.parameter ? p.parameter < q.parameter : p.triangle < q.triangle;
  });
  return result;
}

bool TriangleBvh::hits(const Vector3& a, const Vector3& b) const {
  bool found = false;
  walkSegment(a, b, [&found](std::size_t, double, unsigned) {
    found = true;
    return -1.0;
  });
  return found;
}

void TriangleBvh::forEachInBox(const Bounds& box, const std::function<bool(Index)>& visit) const {
  std::array<std::size_t, kStackSize> stack; // NOLINT: filled as far as it is read
  std::size_t size = 0;
  if (!empty())
    stack[size++] = 0;
  while (size > 0) {
    const std::size_t top = stack[--size];
    const Node& node = nodes_[top];
    if (!node.bounds.overlaps(box))
      continue;
    if (node.count == 0) {
      stack[size++] = static_cast<std::size_t>(node.right);
      stack[size++] = top + 1;
      continue;
    }
    for (auto i = static_cast<std::size_t>(node.first),
              end = i + static_cast<std::size_t>(node.count);
         i < end; ++i) {
      Bounds triangle;
      for (const Vector3& corner : corners_[i])
        triangle.extend(corner);
      if (triangle.overlaps(box) && !visit(order_[i]))
        return;
    }
  }
}

bool TriangleBvh::mayTouch(const Bounds& box) const {
  bool touched = false;
  forEachInBox(box, [&touched](Index) {
    touched = true;
    return false;
  });
  return touched;
}

} // namespace graben
