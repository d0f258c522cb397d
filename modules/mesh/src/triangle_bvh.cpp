#include "graben/mesh/triangle_bvh.h"

#include "bvh_group.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace graben {

namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
constexpr double kUnit = 2.4e-7; ///< two units in the last place of a float between 1 and 2
constexpr double kFar = 1e15;    ///< mesh sizes from the mesh; farther queries are moved there, which makes no box farther
constexpr float kBeyondAll = 1e36F;
constexpr std::size_t kStackSize = 128; ///< the hierarchy is less than 40 nodes deep

struct StackEntry {
  Index child;
  float key; ///< lower bound of the squared distance
};

/// A point as a box that holds it whatever the rounding, in the units of the boxes.
struct ScaledPoint {
  std::array<float, 3> low, high;

  ScaledPoint(const Vector3& low_corner, const Vector3& high_corner) {
    for (int axis = 0; axis < 3; ++axis) {
      const double from = std::clamp(low_corner[axis], -kFar, kFar);
      const double to = std::clamp(high_corner[axis], -kFar, kFar);
      const double slack = kUnit * (1.0 + std::max(std::abs(from), std::abs(to)));
      low[static_cast<std::size_t>(axis)] = static_cast<float>(from - slack);
      high[static_cast<std::size_t>(axis)] = static_cast<float>(to + slack);
    }
  }

  template <typename Node>
  Eigen::Array4f squaredDistances(const Node& node) const {
    Eigen::Array4f sum = Eigen::Array4f::Zero();
    for (std::size_t i = 0; i < 3; ++i)
      sum += (Eigen::Array4f::MapAligned(node.low[i]) - high[i]).max(low[i] - Eigen::Array4f::MapAligned(node.high[i])).max(0.0F).square();
    return sum;
  }
};

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
  ScaledPoint scaled;

  NearestQuery(const TriangleBvh& hierarchy, const Vector3& at, double max_distance)
      : bvh(hierarchy)
      , p(at)
      , rounding(8.0 * kEpsilon * std::max(bvh.scale_, p.cwiseAbs().maxCoeff()))
      , best2(max_distance * max_distance)
      , limit(reach(max_distance))
      , scaled(bvh.scaled(p), bvh.scaled(p)) {}

  float reach(double distance) const {
    const double d = (distance + rounding) * bvh.per_length_;
    return static_cast<float>(std::min(d * d * (1.0 + 1e-6) + 1e-37, static_cast<double>(kBeyondAll)));
  }

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

namespace {

/// \return false if a point is not finite, or so far from the mesh that single precision will not do
bool fill(detail::PointGroup& group, const Vector3* points, std::size_t count, double per_length, const Vector3& origin) {
  constexpr double kFarthest = 64.0; // mesh sizes
  Bounds box;
  for (std::size_t p = 0; p < count; ++p) {
    if (!(((points[p] - origin) * per_length).cwiseAbs().maxCoeff() < kFarthest))
      return false;
    box.extend(points[p]);
  }
  const Vector3 centre = 0.5 * (box.low + box.high);
  Vector3::Map(group.centre) = centre;
  group.count = count;
  for (std::size_t p = 0; p < detail::PointGroup::kSize; ++p) {
    const Vector3 at = (points[std::min(p, count - 1)] - centre) * per_length;
    for (std::size_t i = 0; i < 3; ++i)
      group.at[i][p] = static_cast<float>(at[static_cast<Eigen::Index>(i)]);
  }
  const ScaledPoint scaled((box.low - origin) * per_length, (box.high - origin) * per_length);
  std::copy(scaled.low.begin(), scaled.low.end(), group.low);
  std::copy(scaled.high.begin(), scaled.high.end(), group.high);
  return true;
}

} // namespace

/// \param[in] start place of a triangle to start from, -1 for none
MeshPoint TriangleBvh::nearestFrom(const Vector3& p, Index start) const {
  if (empty() || !p.allFinite())
    return {};
  detail::NearestQuery query(*this, p, std::numeric_limits<double>::infinity());
  if (start >= 0)
    query.look(static_cast<std::size_t>(start));
  search(query);
  return query.best;
}

void TriangleBvh::nearestOneByOne(const Vector3* points, std::size_t count, double* distances, Index* triangles) const {
  for (std::size_t p = 0; p < count; ++p) {
    const MeshPoint found = nearestFrom(points[p], -1);
    distances[p] = found.distance;
    triangles[p] = found.triangle;
  }
}

/// \param[in,out] group with its reach; the rest is working memory
void TriangleBvh::nearestTogether(const Vector3* points, std::size_t count, detail::PointGroup& group, double* distances, Index* triangles) const {
  constexpr std::size_t kFewest = 8; // a kernel's vector
  const detail::BvhView view{nodes_.data(), triangles_.front().data(), vertices_.front().data(), per_length_};
  if (count < kFewest || !fill(group, points, count, per_length_, origin_))
    return nearestOneByOne(points, count, distances, triangles);
  if (!detail::searchGroup(view, group)) {
    nearestTogether(points, count / 2, group, distances, triangles);
    nearestTogether(points + count / 2, count - count / 2, group, distances + count / 2, triangles + count / 2);
    return;
  }
  for (std::size_t p = 0; p < count; ++p) {
    if (!group.isCertain(p)) {
      const MeshPoint found = nearestFrom(points[p], group.place[p]);
      distances[p] = found.distance;
      triangles[p] = found.triangle;
      continue;
    }
    const auto place = static_cast<std::size_t>(group.place[p]);
    const TrianglePoint found = nearestPointOnTriangle(points[p], corner(place, 0), corner(place, 1), corner(place, 2));
    distances[p] = std::sqrt((found.point - points[p]).squaredNorm());
    triangles[p] = order_[place];
  }
}

void TriangleBvh::nearestOfEach(const Vector3* points, std::size_t count, double* distances, Index* triangles) const {
  constexpr double kReach = 4.0; // mean distances of the group before: all but a few normally distributed ones
  detail::PointGroup group;
  if (empty())
    return nearestOneByOne(points, count, distances, triangles);
  for (std::size_t begin = 0, size = 0; begin < count; begin += size) {
    size = std::min(begin == 0 ? 1 : detail::PointGroup::kSize, count - begin);
    nearestTogether(points + begin, size, group, distances + begin, triangles + begin);
    const double sum = std::accumulate(distances + begin, distances + begin + size, 0.0);
    if (std::isfinite(sum))
      group.reach = static_cast<float>(std::min(kReach * sum / static_cast<double>(size) * per_length_, 64.0));
  }
}

/// Calls visit(node, slot) for every leaf whose box may overlap; stops when it returns false. \return false if it was stopped
template <typename Visit>
bool TriangleBvh::walkLeaves(const Bounds& box, const Visit& visit) const {
  if (empty() || !bounds_.overlaps(box))
    return true;
  const ScaledPoint query(scaled(box.low), scaled(box.high));
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

template <typename Visit>
void TriangleBvh::walkBox(const Bounds& box, const Visit& visit) const {
  walkLeaves(box, [&](const Node& node, int k) {
    const Index leaf = node.child[static_cast<std::size_t>(k)];
    for (std::size_t i = firstPlace(leaf); i <= lastPlace(leaf); ++i) {
      Bounds triangle;
      for (std::size_t e = 0; e < 3; ++e)
        triangle.extend(corner(i, e));
      if (triangle.overlaps(box) && !visit(order_[i]))
        return false;
    }
    return true;
  });
}

void TriangleBvh::forEachInBox(const Bounds& box, const std::function<bool(Index)>& visit) const {
  walkBox(box, visit);
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
