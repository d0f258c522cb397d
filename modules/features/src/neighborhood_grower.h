#pragma once

#include "graben/features/tangent_planes.h"
#include "graben/mesh/bounds.h"

namespace graben::detail {

/// growNeighborhood() with its working memory, to be used for many picks by one thread.
class NeighborhoodGrower {
public:
  NeighborhoodGrower(const NeighborGrid& grid, const FaultNetwork& faults,
                     const TangentPlaneOptions& options);

  void grow(Index pick, std::vector<Index>& neighbors);

private:
  struct Candidate {
    Index index;
    double squared_distance; ///< to the pick
    double squared_step;     ///< to the nearest neighbour found so far
    bool open;               ///< may still join
  };

  bool queryCandidates(Index pick, std::size_t count);
  bool growInOrder(Index pick, std::vector<Index>& neighbors) const;
  void growByRounds(Index pick, const Vector3& anchor, std::vector<Index>& neighbors);
  void join(Candidate& candidate, std::vector<Index>& neighbors);
  bool stepsInto(const Vector3& point, const std::vector<Index>& neighbors) const;
  bool mayGrowFurther(const std::vector<Index>& neighbors) const;

  const NeighborGrid& grid_;
  const Points& points_;
  const FaultNetwork& faults_;
  std::size_t wanted_;
  double squared_step_;
  double step_;
  std::vector<Neighbor> found_;
  std::vector<Candidate> candidates_; ///< distinct points other than the pick, nearest first
  bool all_queried_ = false;          ///< no point beyond the candidates is left in the grid
  bool near_fault_ = false;
  bool blocked_ = false; ///< a fault kept a candidate out
};

} // namespace graben::detail
