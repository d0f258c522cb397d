#pragma once

#include "graben/core/types.h"

#include <limits>
#include <memory>
#include <vector>

namespace graben {

/// A pick found by a neighbour query.
struct Neighbor {
  Index index = -1;
  double squared_distance = 0.0;
};

namespace detail {
struct NeighborGridData;
}

/// Exact neighbour queries on a fixed set of points, by a sparse grid of buckets (only cells that
/// hold points are stored).
///
/// Build O(n) on all threads. A query visits the few cells around it, so its cost does not depend
/// on n; where that would be a long way (cells that hold far more than the usual points, a query
/// far from all points) it descends a tree of boxes instead, O(log n). Const methods are
/// thread-safe. Results are ordered by (squared distance, index), equal to the bit to a search
/// through all points with Eigen's squaredNorm(). Points that are not finite are left out of the
/// grid and never found; a query that is not finite finds nothing. Copies share their data.
class NeighborGrid {
public:
  /// An empty grid that finds nothing; points() is empty.
  NeighborGrid();

  /// \param[in] points kept by reference: must outlive the grid and not change
  /// \param[in] cell_size edge of a cell in the points' units; 0 (or not finite) picks one so that
  /// an occupied cell holds about 3 to 4 points \param[in] threads used by the build; 0: one per
  /// processor
  explicit NeighborGrid(const Points& points, double cell_size = 0.0, unsigned threads = 0);

  const Points& points() const { return *points_; }
  /// Number of (finite) points in the grid.
  std::size_t size() const { return order().size(); }
  double cellSize() const;

  /// The \a k nearest points within max_distance (inclusive), nearest first; \a out is overwritten
  /// and keeps its capacity.
  void nearest(const Vector3& query, std::size_t k, std::vector<Neighbor>& out,
               double max_distance = std::numeric_limits<double>::infinity()) const;

  /// All points within \a radius (inclusive), nearest first; \a out is overwritten and keeps its
  /// capacity.
  void within(const Vector3& query, double radius, std::vector<Neighbor>& out) const;

  /// The nearest point; index -1 and an infinite distance if the grid is empty or none is within
  /// max_distance.
  Neighbor nearestOne(const Vector3& query,
                      double max_distance = std::numeric_limits<double>::infinity()) const;

  /// The (finite) point indices in the order of their cells along a space-filling curve: loops in
  /// this order find their data in cache.
  const std::vector<Index>& order() const;

private:
  const Points* points_;
  std::shared_ptr<const detail::NeighborGridData> data_;
};

} // namespace graben
