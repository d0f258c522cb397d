#pragma once

#include "graben/features/orientation.h"

namespace graben::detail {

/// The fault-limited graph of nearest neighbours between the picks that have a normal. Nodes are
/// positions in the grid's order, so that what is near in space is near in memory.
class NeighborGraph {
public:
  NeighborGraph(const NeighborGrid& grid, const FaultNetwork& faults,
                const OrientationOptions& options, const Points& normals);

  struct Edge {
    Index from, to;
    bool against; ///< the normals at its ends point to different sides
  };
  /// All edges, those between the most parallel normals first; equals in the order of their nodes.
  std::vector<Edge> sortedEdges() const;

private:
  void findNeighbors();
  void dropCrossing(std::size_t node);
  float weight(std::size_t from, std::size_t to) const;
  const NeighborGrid& grid_;
  const FaultNetwork& faults_;
  const OrientationOptions& options_;
  Points points_, normals_;      ///< by node
  std::size_t width_;            ///< slots per node
  std::vector<Index> neighbors_; ///< width_ per node, -1 where there is none
  std::vector<double> reach_; ///< squared distance within which all neighbours of a node are known
};

} // namespace graben::detail
