#pragma once

#include "graben/core/export.h"
#include "graben/core/types.h"
#include "graben/mesh/bounds.h"

#include <limits>
#include <memory>
#include <vector>

GRABEN_EXPORT_BEGIN
namespace graben {

/// A pick found by a neighbour query.
struct Neighbor {
  Index index = -1;
  double squared_distance = 0.0;
};

/// Points that follow each other in a grid's order, and so in memory.
struct PointRun {
  const Vector3* points = nullptr; ///< the first of them; coordinates that are not finite may stand among them
  std::size_t count = 0;
  const Index* indices = nullptr; ///< of the points in the caller's cloud; null: first, first + 1, ...
  Index first = 0;                ///< index of the first point where indices is null
  bool may_repeat = true;         ///< false: none of the grid's points is at the place of one of these

  Index index(std::size_t i) const { return indices != nullptr ? indices[i] : first + static_cast<Index>(i); }
};

/// The points around a place, one array for each quantity, so that loops over them vectorise; kept by the caller from query to query.
///
/// The arrays grow as needed and never shrink; only the first \a count values of each are of the last query.
struct PointsAround {
  std::size_t count = 0;
  std::vector<double> dx, dy, dz; ///< point - query
  std::vector<double> squared_distance;
  std::vector<Index> index;
};

namespace detail {
struct CellLattice;
struct NeighborGridData;
struct SortedKeys;
}

/// What spaceOrder() knows of the grid on the points in its order: 8 bytes a point.
using GridKeys = std::shared_ptr<const detail::SortedKeys>;

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

  /// The same grid on points that were put in the order of spaceOrder() and not changed since, in a fraction of the time. \param[in] keys what
  /// spaceOrder() left; null: as if there were none
  NeighborGrid(const Points& points, const GridKeys& keys, unsigned threads = 0);

  /// This grid after some of its points were taken out (set to NaN, the one change that is allowed): they are found no more. Where the points
  /// are inOrder() that costs a fraction of a new grid.
  NeighborGrid withoutThoseTakenOut(unsigned threads = 0) const;
  /// The same where it is known which points these are. \param[in] taken_out their indices in rising order
  NeighborGrid withoutThoseTakenOut(const std::vector<Index>& taken_out, unsigned threads = 0) const;

  const Points& points() const { return *points_; }
  /// Number of (finite) points in the grid.
  std::size_t size() const { return order().size(); }
  double cellSize() const;
  /// Whether the points are in the grid's order already, as spaceOrder() gives it: the grid then holds no copy of them (24 bytes a point
  /// less) and what lies near in space lies near in every array by index.
  bool inOrder() const;

  /// The \a k nearest points within max_distance (inclusive), nearest first; \a out is overwritten
  /// and keeps its capacity.
  void nearest(const Vector3& query, std::size_t k, std::vector<Neighbor>& out,
               double max_distance = std::numeric_limits<double>::infinity()) const;

  /// All points within \a radius (inclusive), nearest first; \a out is overwritten and keeps its
  /// capacity.
  void within(const Vector3& query, double radius, std::vector<Neighbor>& out) const;

  /// Runs of consecutive points that together hold every point within \a radius (inclusive), each once, and others about as far away: for
  /// sums over many points, at a fraction of the cost of within().
  ///
  /// The runs and their order depend on the points and the query alone. Compare distances with <=, so that points that are not finite fall
  /// out. \param[out] runs is overwritten and keeps its capacity
  void runsAround(const Vector3& query, double radius, std::vector<PointRun>& runs) const;

  /// The same for every point within \a radius of a box: for queries at many places in it at once. A box that is empty or not finite has none.
  void runsAround(const Bounds& box, double radius, std::vector<PointRun>& runs) const;

  /// All points within \a radius (inclusive) in the order of runsAround(), not sorted; \a out is overwritten and keeps its capacity. The
  /// distances are those of within() to the bit.
  void collectWithin(const Vector3& query, double radius, PointsAround& out) const;

  /// The nearest point; index -1 and an infinite distance if the grid is empty or none is within
  /// max_distance.
  Neighbor nearestOne(const Vector3& query,
                      double max_distance = std::numeric_limits<double>::infinity()) const;

  /// The (finite) point indices in the order of their cells along a space-filling curve: loops in
  /// this order find their data in cache.
  const std::vector<Index>& order() const;

private:
  NeighborGrid(const Points& points, const detail::CellLattice& lattice, unsigned threads);

  const Points* points_;
  std::shared_ptr<const std::vector<Index>> order_; ///< apart from the rest, which grids share when some of their points are taken out
  std::shared_ptr<const detail::NeighborGridData> data_;
};

/// The indices of the points in the order of a NeighborGrid on them, along a space-filling curve; points that are not finite come last.
///
/// To be called once, before the first grid: put the points and all that belongs to them into this order (points'[i] = points[order[i]]), keep
/// them so, and put results back at the end. Every NeighborGrid on them then is inOrder() and builds in a fraction of the time. O(n) on all
/// threads; needs 44 bytes a point while it runs. \param[in] threads 0: one per processor \param[out] keys if not null: what the first grid on the
/// points in this order may be built from
std::vector<Index> spaceOrder(const Points& points, unsigned threads = 0, GridKeys* keys = nullptr);

} // namespace graben
GRABEN_EXPORT_END
