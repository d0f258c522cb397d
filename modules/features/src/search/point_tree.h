#pragma once

#include "graben/features/neighbor_grid.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace graben::detail {

/// Points in the order of their cells: a copy, or the caller's own where they are in order.
struct OrderedPoints {
  const Vector3* points = nullptr;
  std::size_t count = 0;
  const Index* indices = nullptr; ///< of the points in the caller's cloud; null if they are in order
  Points copy;                    ///< empty if they are in order

  Index indexOf(std::size_t i) const { return indices == nullptr ? static_cast<Index>(i) : indices[i]; }
  double squaredDistance(std::size_t i, const Vector3& q) const {
    const Vector3& p = points[i];
    const double dx = p.x() - q.x(), dy = p.y() - q.y(), dz = p.z() - q.z();
    return dx * dx + dy * dy + dz * dz;
  }
};

inline bool closer(const Neighbor& a, const Neighbor& b) {
  return a.squared_distance < b.squared_distance ||
         (a.squared_distance == b.squared_distance && a.index < b.index);
}

/// Hierarchy of tight boxes over points that lie along a space-filling curve: 8 points in a leaf, 8
/// nodes in a node.
///
/// Its queries cost O(log n) whatever the density and wherever the query lies; the grid falls back
/// on it where a walk over cells would be long. Nodes know their least index, so a pile of
/// identical points costs no more than any other.
class PointTree {
public:
  void build(const OrderedPoints& points, unsigned threads);

  /// The k nearest points with squared distance of at most \a limit, in no order (a heap); \a out
  /// is overwritten.
  void nearest(const OrderedPoints& points, const Vector3& query, std::size_t k, double limit,
               std::vector<Neighbor>& out) const;

  /// The nearest point with squared distance of at most \a limit; index -1 and an infinite distance
  /// if there is none.
  Neighbor nearestOne(const OrderedPoints& points, const Vector3& query, double limit) const;

  /// Calls visit(i, squared distance) for all points with squared distance of at most \a limit.
  template <typename Visit>
  void visitWithin(const OrderedPoints& points, const Vector3& query, double limit, const Visit& visit) const {
    traverse(
        points.count, query, [&](double squared_distance, Index) { return !(squared_distance <= limit); },
        [&](std::size_t i) {
          const double squared_distance = points.squaredDistance(i, query);
          if (squared_distance <= limit)
            visit(i, squared_distance);
        });
  }

  /// Calls visit(first, end) for the leaves, in their order, that together hold all points with squared distance from the box of at most \a limit.
  template <typename Visit>
  void visitLeaves(std::size_t points, const Bounds& box, double limit, const Visit& visit) const;

private:
  static constexpr std::size_t FAN = 8;
  static constexpr std::size_t MAX_STACK = FAN * 12; // 12 levels of 8 hold more points than an Index counts

  struct Node {
    Vector3 low = Vector3::Constant(std::numeric_limits<double>::infinity());
    Vector3 high = -low; ///< the box of a node without points is infinitely far from everything
    Index least_index = std::numeric_limits<Index>::max();

    void extend(const Node& other) {
      low = low.cwiseMin(other.low);
      high = high.cwiseMax(other.high);
      least_index = std::min(least_index, other.least_index);
    }
    double squaredDistance(const Vector3& q) const { return squaredDistance(Bounds{q, q}); }
    double squaredDistance(const Bounds& box) const {
      // The order of operations of a point's distance, so that rounding never puts the box behind a
      // point in it.
      const Vector3 d = (low - box.high).cwiseMax(box.low - high).cwiseMax(0.0);
      return d.x() * d.x() + d.y() * d.y() + d.z() * d.z();
    }
  };
  struct Entry {
    double squared_distance;
    Index least_index;
    std::uint32_t level;
    std::size_t node;
    bool isAfter(const Entry& other) const {
      return squared_distance > other.squared_distance ||
             (squared_distance == other.squared_distance && least_index > other.least_index);
    }
  };

  template <typename Prune, typename Visit>
  void traverse(std::size_t points, const Vector3& query, const Prune& prune,
                const Visit& visit) const;

  std::vector<std::vector<Node>> levels_; ///< leaves first, root last
};

template <typename Visit>
void PointTree::visitLeaves(std::size_t points, const Bounds& box, double limit, const Visit& visit) const {
  if (levels_.empty())
    return;
  struct Place {
    std::size_t level, node;
  };
  std::array<Place, MAX_STACK> stack;
  stack[0] = {levels_.size() - 1, 0};
  std::size_t top = 1;
  while (top > 0) {
    const Place place = stack[--top];
    const std::size_t begin = place.node * FAN;
    if (place.level == 0) {
      visit(begin, std::min(points, begin + FAN));
      continue;
    }
    const std::vector<Node>& children = levels_[place.level - 1];
    for (std::size_t c = std::min(children.size(), begin + FAN); c-- > begin;)
      if (children[c].squaredDistance(box) <= limit)
        stack[top++] = {place.level - 1, c};
  }
}

/// Nearest nodes first; prune(squared distance, least index) is asked before a node is opened,
/// visit(i) gets each point of an opened leaf.
template <typename Prune, typename Visit>
void PointTree::traverse(std::size_t points, const Vector3& query, const Prune& prune,
                         const Visit& visit) const {
  if (levels_.empty())
    return;
  std::array<Entry, MAX_STACK> stack;
  const Node& root = levels_.back().front();
  stack[0] = {root.squaredDistance(query), root.least_index,
              static_cast<std::uint32_t>(levels_.size() - 1), 0};
  std::size_t top = 1;
  while (top > 0) {
    const Entry entry = stack[--top];
    if (prune(entry.squared_distance, entry.least_index))
      continue;
    const std::size_t begin = entry.node * FAN;
    if (entry.level == 0) {
      for (std::size_t i = begin; i < std::min(points, begin + FAN); ++i)
        visit(i);
      continue;
    }
    const std::vector<Node>& children = levels_[entry.level - 1];
    const std::size_t first = top;
    for (std::size_t c = begin; c < std::min(children.size(), begin + FAN); ++c) {
      const Entry child{children[c].squaredDistance(query), children[c].least_index,
                        entry.level - 1, c};
      if (prune(child.squared_distance, child.least_index))
        continue;
      std::size_t at = top++;
      for (; at > first && child.isAfter(stack[at - 1]); --at)
        stack[at] = stack[at - 1];
      stack[at] = child;
    }
  }
}

} // namespace graben::detail
