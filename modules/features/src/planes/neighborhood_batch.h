#pragma once

#include "graben/faults/fault_slabs.h"
#include "graben/features/tangent_planes.h"
#include "planes/measured_normals.h"
#include "planes/nearest_moments.h"

namespace graben::detail {

/// The constrained neighbourhoods of picks near each other that are simply their K nearest points: all of them a step away, behind no fault and
/// without a measured normal near. What is around all of the picks is looked up once; for use by one thread.
class NeighborhoodBatch {
public:
  NeighborhoodBatch(const NeighborGrid& grid, const FaultNetwork& faults, const MeasuredNormals& measured, const TangentPlaneOptions& options);

  /// How many of the picks, from the first on, to take together.
  std::size_t extent(const Index* picks, std::size_t count) const;

  /// Looks at that many picks; those that are not simple need a NeighborhoodGrower.
  void find(const Index* picks, std::size_t count);
  bool isSimple(std::size_t i) const { return simple_[i]; }
  /// Of the neighbourhood of a simple pick about it, equal to the bit to those of the same points in other places of the grid.
  const Moments& moments(std::size_t i) const { return moments_[i]; }

private:
  bool gather(const Bounds& box);
  void leaveOutRepeated();
  void search(const Index* picks);
  bool allJoin(const Vector3& pick);
  void markSides(const Bounds& box);
  bool crossesFault(const Vector3& pick) const;
  const Vector3& pointOf(Index i) const { return points_[static_cast<std::size_t>(i)]; }

  const NeighborGrid& grid_;
  const Points& points_;
  const FaultNetwork& faults_;
  const MeasuredNormals& measured_;
  std::size_t wanted_;           ///< neighbours besides the pick
  double squared_step_;
  double max_distance_;
  double radius_ = 0.0;          ///< likely to hold the neighbourhoods of the next picks; 0: not known
  std::vector<bool> simple_;
  std::vector<Moments> moments_;
  std::vector<std::size_t> open_; ///< picks whose neighbours are to be looked for in a wider ball
  NearbyPoints nearby_;
  FaultSlabs slabs_;                             ///< around the picks
  std::vector<FaultSlabs::Mark> marks_;          ///< of the points around, where there are slabs
  std::vector<Index> within_step_, beyond_step_; ///< the same by their distance to it
  std::vector<PointRun> runs_;
  std::vector<Index> around_; ///< the points around, of which nearby_ holds the places, in the order of their indices
  std::vector<Index> places_; ///< hash table of points; -1 where free
};

} // namespace graben::detail
