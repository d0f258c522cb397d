#pragma once

#include "graben/features/tangent_planes.h"
#include "graben/mesh/bounds.h"

namespace graben::detail {

/// growNeighborhood() with its working memory, to be used for many picks by one thread.
class NeighborhoodGrower {
public:
  NeighborhoodGrower(const NeighborGrid& grid, const FaultNetwork& faults,
                     const TangentPlaneOptions& options);

  /// The neighbourhood of a pick, itself first.
  void grow(Index pick, std::vector<Index>& neighbors);
  /// The neighbourhood of any place, among the picks; a pick at that very place comes first.
  void growAt(const Vector3& place, std::vector<Index>& neighbors);

private:
  struct Candidate {
    Index index;
    double squared_distance; ///< to the pick
    double squared_step;     ///< to the nearest neighbour found so far
    bool open;               ///< may still join
  };

  void growFromHere(std::vector<Index>& neighbors);
  bool takeNearest(std::vector<Index>& neighbors);
  bool isFirstAtItsPlace(std::size_t i) const;
  bool queryCandidates(std::size_t count);
  void start(std::vector<Index>& neighbors) const;
  bool growInOrder(std::vector<Index>& neighbors) const;
  void growByRounds(const Vector3& anchor, std::vector<Index>& neighbors);
  void join(Candidate& candidate, std::vector<Index>& neighbors);
  bool stepsInto(const Vector3& point, const std::vector<Index>& neighbors) const;
  bool mayGrowFurther(const std::vector<Index>& neighbors) const;

  const NeighborGrid& grid_;
  const Points& points_;
  const FaultNetwork& faults_;
  std::size_t wanted_;
  double step_;
  double squared_step_;
  double max_distance_;
  Vector3 place_ = Vector3::Zero();
  Index pick_ = -1; ///< the pick at that place, -1 if none
  std::vector<Neighbor> found_;
  std::vector<Candidate> candidates_; ///< distinct points other than the pick, nearest first
  bool all_queried_ = false;          ///< no point beyond the candidates is left in the grid
  bool near_fault_ = false;
  bool blocked_ = false; ///< a fault kept a candidate out
};

} // namespace graben::detail
