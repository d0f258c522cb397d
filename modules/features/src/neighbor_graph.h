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
  };
  /// All edges, those between the most parallel normals first; equals in the order of their nodes.
  std::vector<Edge> sortedEdges() const;

private:
  void findNeighbors();
  void dropCrossing(std::size_t node);
  float weight(std::size_t from, std::size_t to) const;
  Index pick(std::size_t node) const { return grid_.order()[node]; }
  const Vector3& normal(std::size_t node) const {
    return normals_[static_cast<std::size_t>(pick(node))];
  }
  const Vector3& point(std::size_t node) const {
    return grid_.points()[static_cast<std::size_t>(pick(node))];
  }

  const NeighborGrid& grid_;
  const FaultNetwork& faults_;
  const OrientationOptions& options_;
  const Points& normals_;
  std::size_t width_;            ///< slots per node
  std::vector<Index> neighbors_; ///< width_ per node, -1 where there is none
  std::vector<double> reach_; ///< squared distance within which all neighbours of a node are known
};

} // namespace graben::detail
