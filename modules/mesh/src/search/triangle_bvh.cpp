#include "graben/mesh/triangle_bvh.h"

#include "search/scaled_box.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace graben {

namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
constexpr std::size_t kStackSize = 128; ///< the hierarchy is less than 40 nodes deep

struct StackEntry {
  Index child;
  float key; ///< lower bound of the squared distance
};

/// True if all points lie on one side of a triangle's plane, by more than rounding makes the segment queries wrong.
/// \param[in] tolerance of those queries: what is nearer counts as touching
bool liesAside(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3* points, std::size_t count, double tolerance) {
  const auto sumOf = [](const Vector3& v) { return v.cwiseAbs().sum(); }; // no less than the length
  const Vector3 normal = (b - a).cross(c - a);
  const double rounding = 8.0 * kEpsilon * sumOf(b - a) * sumOf(c - a);
  const double least = 2.0 * tolerance * sumOf(normal);
  bool above = true;
  bool below = true;
  for (std::size_t i = 0; i < count && (above || below); ++i) {
    const Vector3 from = points[i] - a;
    const double volume = normal.dot(from);
    const double limit = least + rounding * sumOf(from);
    above = above && volume > limit;
    below = below && volume < -limit;
  }
  return above || below;
}

} // namespace

namespace detail {

/// One search: the best so far, and how far from it boxes still count.
struct NearestQuery {
  const TriangleBvh& bvh;
  Vector3 p;
  double rounding; ///< boxes are passed over only where they are farther than the best by more than this, so that ties are seen
  double best2;
  float limit; ///< squared distance of boxes, in their units
  Index place = -1;
  MeshPoint best = {};
  ScaledBox scaled;

  NearestQuery(const TriangleBvh& hierarchy, const Vector3& at, double max_distance)
      : bvh(hierarchy)
      , p(at)
      , rounding(8.0 * kEpsilon * std::max(bvh.scale_, p.cwiseAbs().maxCoeff()))
      , best2(max_distance * max_distance)
      , limit(reach(max_distance))
      , scaled(bvh.scaled(p), bvh.scaled(p)) {}

  float reach(double distance) const { return squaredReach(distance + rounding, bvh.per_length_); }

  void look(std::size_t i) {
    const TrianglePoint found = nearestPointOnTriangle(p, bvh.corner(i, 0), bvh.corner(i, 1), bvh.corner(i, 2));
    const double d2 = (found.point - p).squaredNorm();
    if (!(d2 < best2 || (d2 == best2 && (place < 0 || bvh.order_[i] < best.triangle))))
      return;
    best2 = d2;
    best = {bvh.order_[i], found.point, found.barycentric, std::sqrt(d2)};
    place = static_cast<Index>(i);
    limit = reach(best.distance);
  }

  void lookAtLeaf(Index leaf) {
    for (std::size_t i = TriangleBvh::firstPlace(leaf); i <= TriangleBvh::lastPlace(leaf); ++i)
      look(i);
  }
};

} // namespace detail

void TriangleBvh::search(detail::NearestQuery& query) const {
  std::array<StackEntry, kStackSize> stack; // NOLINT: filled as far as it is read
  std::size_t size = 0;
  stack[size++] = {0, 0.0F};
  while (size > 0) {
    const StackEntry top = stack[--size];
    if (top.key > query.limit)
      continue;
    if (top.child < 0) {
      query.lookAtLeaf(top.child);
      continue;
    }
    const Node& node = nodes_[static_cast<std::size_t>(top.child)];
    const Eigen::Array4f keys = query.scaled.squaredDistances(node);
    const std::size_t base = size;
    for (int k = 0; k < 4; ++k) {
      if (!(keys[k] <= query.limit) || node.child[static_cast<std::size_t>(k)] == kNoChild)
        continue;
      std::size_t at = size++;
      for (; at > base && stack[at - 1].key < keys[k]; --at) // the nearest comes on top
        stack[at] = stack[at - 1];
      stack[at] = {node.child[static_cast<std::size_t>(k)], keys[k]};
    }
  }
}

MeshPoint TriangleBvh::nearest(const Vector3& p, double max_distance) const {
  if (empty() || !p.allFinite() || !(max_distance >= 0.0))
    return {};
  detail::NearestQuery query(*this, p, max_distance);
  search(query);
  return query.best;
}

/// Calls visit(node, slot) for every leaf whose box may overlap; stops when it returns false. \return false if it was stopped
template <typename Visit>
bool TriangleBvh::walkLeaves(const Bounds& box, const Visit& visit) const {
  if (empty() || !bounds_.overlaps(box))
    return true;
  const detail::ScaledBox query(scaled(box.low), scaled(box.high));
  std::array<Index, kStackSize> stack; // NOLINT: filled as far as it is read
  std::size_t size = 0;
  stack[size++] = 0;
  while (size > 0) {
    const Node& node = nodes_[static_cast<std::size_t>(stack[--size])];
    const Eigen::Array4f distances = query.squaredDistances(node);
    for (int k = 0; k < 4; ++k) {
      const Index child = node.child[static_cast<std::size_t>(k)];
      if (!(distances[k] <= 0.0F) || child == kNoChild)
        continue;
      if (child >= 0)
        stack[size++] = child;
      else if (!visit(node, k))
        return false;
    }
  }
  return true;
}

Bounds TriangleBvh::boundsOf(std::size_t place) const {
  Bounds box;
  for (std::size_t e = 0; e < 3; ++e)
    box.extend(corner(place, e));
  return box;
}

template <typename Visit>
void TriangleBvh::walkBox(const Bounds& box, const Visit& visit) const {
  walkLeaves(box, [&](const Node& node, int k) {
    const Index leaf = node.child[static_cast<std::size_t>(k)];
    for (std::size_t i = firstPlace(leaf); i <= lastPlace(leaf); ++i) {
      if (boundsOf(i).overlaps(box) && !visit(order_[i]))
        return false;
    }
    return true;
  });
}

void TriangleBvh::forEachInBox(const Bounds& box, const std::function<bool(Index)>& visit) const {
  walkBox(box, visit);
}

bool TriangleBvh::mayPart(const Vector3* points, std::size_t count) const {
  Bounds box;
  for (std::size_t i = 0; i < count; ++i)
    box.extend(points[i]);
  if (empty() || box.empty())
    return false;
  const double tolerance = 16.0 * kEpsilon * std::max({scale_, box.low.cwiseAbs().maxCoeff(), box.high.cwiseAbs().maxCoeff()});
  box.low.array() -= tolerance;
  box.high.array() += tolerance;
  bool part = false;
  walkLeaves(box, [&](const Node& node, int k) {
    const Index leaf = node.child[static_cast<std::size_t>(k)];
    for (std::size_t i = firstPlace(leaf); i <= lastPlace(leaf) && !part; ++i)
      part = !liesAside(corner(i, 0), corner(i, 1), corner(i, 2), points, count, tolerance) && boundsOf(i).overlaps(box);
    return !part;
  });
  return part;
}

bool TriangleBvh::mayTouch(const Bounds& box) const {
  bool touched = false;
  walkBox(box, [&touched](Index) {
    touched = true;
    return false;
  });
  return touched;
}

} // namespace graben
