#pragma once

#include "graben/features/orientation.h"

namespace graben::detail {

/// The fault-limited graph of nearest neighbours between the picks that have a normal; edges are found when asked for.
///
/// Nodes are numbered along the grid's order, so that what is near in space is near in memory; const methods are thread-safe.
class NeighborGraph {
public:
  NeighborGraph(const NeighborGrid& grid, const FaultNetwork& faults, const OrientationOptions& options, const Points& normals);

  /// Number of nodes; some may be picks without a normal, which have no edges.
  std::size_t size() const { return count_; }
  std::size_t pickOf(Index node) const {
    return static_cast<std::size_t>(in_order_ ? node : grid_.order()[static_cast<std::size_t>(node)]);
  }
  bool hasNormal(Index node) const { return normals_[pickOf(node)].allFinite(); }
  /// Whether the normals of two nodes point to different sides.
  bool against(Index a, Index b) const { return normals_[pickOf(a)].dot(normals_[pickOf(b)]) < 0.0; }
  /// 1 - |n_a . n_b|, 0 or more.
  float weight(Index a, Index b) const;

  /// The nodes that edges lead to, nearest first; found: working memory.
  void neighborsOf(Index node, std::vector<Neighbor>& found, std::vector<Index>& nodes) const;

  enum class Around { Agree, Differ, TooMany };
  /// Whether the normals of nodes [begin, end) and of all that their edges may lead to are so near to one line that no edge there contradicts
  /// another. A bound: Differ or TooMany (looked at) says nothing. \param[out] nodes all of these nodes, if they agree; runs: working memory
  Around lookAround(Index begin, Index end, std::vector<PointRun>& runs, std::vector<Index>& nodes) const;

private:
  void dropCrossing(Index node, std::vector<Index>& nodes) const;
  Index nodeOf(Index pick) const { return in_order_ ? pick : position_[static_cast<std::size_t>(pick)]; }
  const Vector3& pointOf(Index node) const { return grid_.points()[pickOf(node)]; }

  const NeighborGrid& grid_;
  const FaultNetwork& faults_;
  const Points& normals_;
  bool in_order_;
  std::size_t count_;
  std::size_t width_; ///< most edges that start at a node
  double longest_;
  bool may_look_around_;
  std::vector<Index> position_; ///< of each pick in the grid's order; empty if the picks are in order
};

} // namespace graben::detail
