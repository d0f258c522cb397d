#pragma once

#include "graben/core/types.h"
#include "graben/mesh/bounds.h"

#include <cstdint>
#include <limits>
#include <vector>

namespace graben {

/// A pick found by a neighbour query.
struct Neighbor {
  Index index = -1;
  double squared_distance = 0.0;
};

/// Exact neighbour queries on a fixed set of points, by a sparse grid of buckets (only cells that hold points are stored).
///
/// Build O(n log n), 2 threads or more in use; a query visits the few cells around it, so its cost does not depend on n as long as
/// the points lie on a sheet. Const methods are thread-safe. Results are ordered by (distance, index): deterministic.
/// Points that are not finite are left out of the grid and never found; a query that is not finite finds nothing.
class NeighborGrid {
public:
  NeighborGrid() = default;

  /// \param[in] points kept by reference: must outlive the grid and not change
  /// \param[in] cell_size edge of a cell in the points' units; 0 picks one so that an occupied cell holds about 4 points
  explicit NeighborGrid(const Points& points, double cell_size = 0.0, unsigned threads = 0);

  const Points& points() const { return *points_; }
  /// Number of (finite) points in the grid.
  std::size_t size() const { return order_.size(); }
  double cellSize() const { return cell_size_; }

  /// The \a k nearest points within max_distance (inclusive), nearest first; \a out is overwritten and keeps its capacity.
  void nearest(const Vector3& query, std::size_t k, std::vector<Neighbor>& out,
               double max_distance = std::numeric_limits<double>::infinity()) const;

  /// All points within \a radius (inclusive), nearest first.
  void within(const Vector3& query, double radius, std::vector<Neighbor>& out) const;

  /// The nearest point; index -1 if the grid is empty or none is within max_distance.
  Neighbor nearestOne(const Vector3& query, double max_distance = std::numeric_limits<double>::infinity()) const;

  /// The (finite) point indices in the order of their cells along a space-filling curve: loops in this order find their data in cache.
  const std::vector<Index>& order() const { return order_; }

private:
  const Points* points_ = nullptr;
  double cell_size_ = 0.0;
  Vector3 low_ = Vector3::Zero();
  std::vector<Index> order_;
  std::vector<std::uint64_t> keys_;   ///< occupied cells, sorted
  std::vector<std::uint32_t> starts_; ///< first entry of each cell in order_, one more at the end
  std::vector<std::uint32_t> table_;  ///< open-addressing hash: cell key -> position in keys_
};

} // namespace graben
