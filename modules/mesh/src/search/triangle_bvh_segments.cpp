#include "graben/mesh/triangle_bvh.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace graben {

namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
constexpr std::size_t kStackSize = 128; ///< the hierarchy is less than 40 nodes deep

using Corners = std::array<const Vector3*, 3>;

/// A segment made ready for many tests.
struct SegmentQuery {
  Vector3 a, b, d;
  double tolerance; ///< distance within which something is on the segment's end or a triangle's edge
  double length;

  SegmentQuery(const Vector3& from, const Vector3& to, double scale)
      : a(from)
      , b(to)
      , d(to - from) {
    tolerance = 8.0 * kEpsilon * std::max({scale, a.cwiseAbs().maxCoeff(), b.cwiseAbs().maxCoeff()});
    length = d.norm();
  }
};

/// The segment in the units of the boxes: where boxes may meet it is told by their projections on the axes and on the
/// axes' cross products with it (Gottschalk 1996), each grown by more than the rounding in float.
struct ScaledSegment {
  std::array<float, 3> middle, half, reach;
  float slack;

  ScaledSegment(const Vector3& a, const Vector3& b, double tolerance) {
    constexpr double kUnit = 2.4e-7; // two units in the last place of a float between 1 and 2
    constexpr double kFar = 1e6;     // mesh sizes beyond which floats tell nothing
    const double size = std::max(a.cwiseAbs().maxCoeff(), b.cwiseAbs().maxCoeff());
    slack = static_cast<float>(size < kFar ? kUnit * (1.0 + size) + 2.0 * tolerance : 1e15);
    for (int axis = 0; axis < 3; ++axis) {
      const double from = std::clamp(a[axis], -1e12, 1e12);
      const double to = std::clamp(b[axis], -1e12, 1e12);
      const auto i = static_cast<std::size_t>(axis);
      middle[i] = static_cast<float>(0.5 * (from + to));
      half[i] = static_cast<float>(0.5 * (to - from));
      reach[i] = std::abs(half[i]) + slack;
    }
  }

  template <typename Node>
  Eigen::Array<bool, 4, 1> meets(const Node& node) const {
    std::array<Eigen::Array4f, 3> to, size;
    Eigen::Array4f outside = Eigen::Array4f::Constant(-1.0F);
    for (std::size_t i = 0; i < 3; ++i) {
      const auto low = Eigen::Array4f::MapAligned(node.low[i]);
      const auto high = Eigen::Array4f::MapAligned(node.high[i]);
      to[i] = 0.5F * (low + high) - middle[i];
      size[i] = 0.5F * (high - low);
      outside = outside.max(to[i].abs() - size[i] - reach[i]);
    }
    if ((outside > 0.0F).all())
      return outside <= 0.0F;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      const std::size_t k = (i + 2) % 3;
      const float hj = std::abs(half[j]);
      const float hk = std::abs(half[k]);
      outside = outside.max((half[j] * to[k] - half[k] * to[j]).abs() - (size[j] * hk + size[k] * hj) - 4.0F * slack * (hj + hk));
    }
    return outside <= 0.0F;
  }
};

int signBeyond(double value, double limit) {
  return value > limit ? 1 : (value < -limit ? -1 : 0);
}

double sumOf(const Vector3& v) {
  return v.cwiseAbs().sum();
}

/// Where a segment meets one triangle.
struct TriangleHit {
  double parameter = 0.0;
  unsigned on_edges = 0; ///< bit e: on edge e, within tolerance
};

/// Signed volumes decide, each against a bound on its own rounding error; what is in doubt counts
/// as touching. So of the two triangles at an edge at least one is hit, whichever way the rounding
/// went. Sums of absolute coordinates, which are no less than lengths, settle most cases.
bool meets(const SegmentQuery& s, const Corners& c, TriangleHit& hit) {
  const Vector3 e1 = *c[1] - *c[0];
  const Vector3 e2 = *c[2] - *c[0];
  const Vector3 n = e1.cross(e2);
  const Vector3 from_a = s.a - *c[0];
  const Vector3 from_b = s.b - *c[0];
  const double va = n.dot(from_a);
  const double vb = n.dot(from_b);
  const double most = s.tolerance * sumOf(n);
  const double most_error = 4.0 * kEpsilon * sumOf(e1) * sumOf(e2);
  const double most_a = most + most_error * sumOf(from_a);
  const double most_b = most + most_error * sumOf(from_b);
  if ((va > most_a && vb > most_b) || (va < -most_a && vb < -most_b))
    return false;
  const double n_length = n.norm();
  if (!(n_length > 0.0))
    return false;
  const double n_error = 4.0 * kEpsilon * e1.norm() * e2.norm();
  const int side_a = signBeyond(va, s.tolerance * n_length + n_error * from_a.norm());
  const int side_b = signBeyond(vb, s.tolerance * n_length + n_error * from_b.norm());
  if (side_a == side_b)
    return false;
  const int direction = side_a != 0 ? -side_a : side_b;
  hit.on_edges = 0;
  for (unsigned e = 0; e < 3; ++e) {
    const Vector3 edge = *c[(e + 1) % 3] - *c[e];
    const double volume = direction * edge.dot(s.d.cross(*c[e] - s.a));
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

  EdgeHit(const SegmentHit& h, const std::array<const Vector3*, 3>& c, unsigned on_edges)
      : hit(h) {
    for (unsigned e = 0; e < 3; ++e) {
      const bool here = (on_edges & (1U << e)) != 0;
      const bool before = (on_edges & (1U << ((e + 2) % 3))) != 0;
      if (here && before) {
        ends = {c[e], c[e]};
        return;
      }
      if (here)
        ends = {c[e], c[(e + 1) % 3]};
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

/// \param[in] on_hit called with place, parameter and edges of every hit; ends the walk by returning false
template <typename OnHit>
void TriangleBvh::walkSegment(const Vector3& a, const Vector3& b, const OnHit& on_hit) const {
  if (empty() || !a.allFinite() || !b.allFinite())
    return;
  const SegmentQuery segment(a, b, scale_);
  const ScaledSegment query(scaled(a), scaled(b), segment.tolerance * per_length_);
  std::array<Index, kStackSize> stack; // NOLINT: filled as far as it is read
  std::size_t size = 0;
  stack[size++] = 0;
  while (size > 0) {
    const Node& node = nodes_[static_cast<std::size_t>(stack[--size])];
    const Eigen::Array<bool, 4, 1> meeting = query.meets(node);
    for (int k = 0; k < 4; ++k) {
      const Index child = node.child[static_cast<std::size_t>(k)];
      if (!meeting[k] || child == kNoChild)
        continue;
      if (child >= 0) {
        stack[size++] = child;
        continue;
      }
      TriangleHit hit;
      for (std::size_t i = firstPlace(child); i <= lastPlace(child); ++i)
        if (meets(segment, {&corner(i, 0), &corner(i, 1), &corner(i, 2)}, hit) && !on_hit(i, hit.parameter, hit.on_edges))
          return;
    }
  }
}

std::optional<SegmentHit> TriangleBvh::firstHit(const Vector3& a, const Vector3& b) const {
  SegmentHit best;
  walkSegment(a, b, [&](std::size_t i, double parameter, unsigned) {
    if (best.triangle < 0 || parameter < best.parameter || (parameter == best.parameter && order_[i] < best.triangle))
      best = {order_[i], parameter, pointAt(a, b, parameter)};
    return true;
  });
  return best.triangle < 0 ? std::nullopt : std::optional<SegmentHit>(best);
}

std::vector<SegmentHit> TriangleBvh::allHits(const Vector3& a, const Vector3& b) const {
  std::vector<EdgeHit> found;
  walkSegment(a, b, [&](std::size_t i, double parameter, unsigned on_edges) {
    found.emplace_back(SegmentHit{order_[i], parameter, pointAt(a, b, parameter)}, Corners{&corner(i, 0), &corner(i, 1), &corner(i, 2)},
                       on_edges);
    return true;
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

std::size_t TriangleBvh::countHits(const Vector3& a, const Vector3& b) const {
  std::size_t count = 0;
  bool on_edge = false;
  walkSegment(a, b, [&](std::size_t, double, unsigned on_edges) {
    ++count;
    on_edge = on_edges != 0;
    return !on_edge;
  });
  return on_edge ? allHits(a, b).size() : count;
}

bool TriangleBvh::hits(const Vector3& a, const Vector3& b) const {
  bool found = false;
  walkSegment(a, b, [&found](std::size_t, double, unsigned) {
    found = true;
    return false;
  });
  return found;
}

} // namespace graben
