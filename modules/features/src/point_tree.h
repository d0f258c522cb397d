#pragma once

#include "graben/features/neighbor_grid.h"

namespace graben::detail {

/// Coordinates of points in the order of their cells, one array per axis.
struct OrderedPoints {
  std::vector<double> x, y, z;
  std::vector<Index> index; ///< of the point in the caller's cloud

  double squaredDistance(std::size_t i, const Vector3& q) const {
    const double dx = x[i] - q.x(), dy = y[i] - q.y(), dz = z[i] - q.z();
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

  /// All points with squared distance of at most \a limit, in no order; \a out is overwritten.
  void within(const OrderedPoints& points, const Vector3& query, double limit,
              std::vector<Neighbor>& out) const;

private:
  struct Node {
    Vector3 low, high;
    Index least_index;
    double squaredDistance(const Vector3& q) const {
      // The order of operations of a point's distance, so that rounding never puts the box behind a
      // point in it.
      const Vector3 d = (low - q).cwiseMax(q - high).cwiseMax(0.0);
      return d.x() * d.x() + d.y() * d.y() + d.z() * d.z();
    }
  };
  template <typename Prune, typename Visit>
  void traverse(std::size_t points, const Vector3& query, const Prune& prune,
                const Visit& visit) const;

  std::vector<std::vector<Node>> levels_; ///< leaves first, root last
};

} // namespace graben::detail
