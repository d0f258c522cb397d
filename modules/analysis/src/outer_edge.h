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

  /// True if a point lies beyond the edge, beside the truth rather than over it, or beside a fault's border no farther from where the edge begins than
  /// from this border. \param[in] nearest the point of the truth nearest to it
  bool isBeyond(const Vector3& p, const MeshPoint& nearest) const;

  /// True within \a distance of the edge.
  bool isNear(const Vector3& p, double distance) const { return !edge_.empty() && edge_.nearest(p, distance).triangle >= 0; }

  /// Where the edge meets a fault.
  const Points& ends() const { return ends_; }

private:
  enum class Border : char { No, Outer, Fault };
  Border borderAt(const MeshPoint& nearest) const;

  const TriangleMesh& truth_;
  std::vector<Border> half_edge_; ///< by 3 * triangle + number of the edge in it
  std::vector<Border> vertex_;    ///< Outer where both meet
  Points ends_;
  TriangleBvh edge_; ///< triangles without width
};

} // namespace graben
