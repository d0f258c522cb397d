#pragma once

#include "graben/faults/fault_network.h"
#include "graben/mesh/triangle_bvh.h"

#include <vector>

namespace graben {

/// The border of the true surface that does not lie at a fault: where the area ends in which it is known.
class OuterEdge {
public:
  /// \param[in] tolerance border edges whose middle is up to this far from a fault are the fault's
  OuterEdge(const TriangleMesh& truth, const FaultNetwork& network, double tolerance, unsigned threads);

  /// True if a point lies beyond the edge, beside the truth rather than over it. \param[in] nearest the point of the truth nearest to it
  bool isBeyond(const Vector3& p, const MeshPoint& nearest) const;

  /// Where the edge meets a fault.
  Points ends() const;

private:
  bool isOnEdge(const MeshPoint& nearest) const;

  const TriangleMesh& truth_;
  std::vector<char> half_edge_; ///< by 3 * triangle + number of the edge in it
  std::vector<char> vertex_;
  std::vector<char> at_fault_; ///< vertices of border edges at a fault
};

} // namespace graben
