#pragma once

#include "kriging_system.h"

#include "graben/mesh/triangle_bvh.h"

namespace graben::detail {

/// How near to each other the nodes of a surface are: to move it, or only to compare correlations, at a small part of the cost.
enum class NodesFor { Moves, Comparison };

/// One linearisation of a surface that picks hold, about the surface as it is.
class Kriging {
public:
  /// All must outlive this. \param[in] normals unit, of the mesh's vertices, along which these move
  Kriging(const CutMesh& cut, const Points& normals, const VertexCorners& corners, const Points& picks, const FaultNetwork& faults,
          const KrigingOptions& options, NodesFor nodes);

  /// How many hold the surface.
  std::size_t picks() const { return picks_.size(); }

  /// The moves of all vertices along their normals.
  std::vector<double> moves(const SurfaceCorrelation& correlation) const;

  /// By which correlations are compared; of a large surface those of some of its windows.
  std::vector<KrigingSystem> systemsToCompare() const;

private:
  double nodeSpacing(NodesFor nodes) const;
  void placeSights(const VertexCorners& corners);
  void addPicks(const Points& picks);
  bool addPick(const Vector3& pick, const TriangleBvh& bvh, KrigedPick& made) const;
  void makeWindows(std::size_t most_nodes);

  const Vector3& placeOf(std::size_t node) const { return mesh_.vertices[static_cast<std::size_t>(nodes_.vertex[node])]; }
  std::vector<Index> grown(const std::vector<Index>& window) const;
  KrigingSystem systemOf(std::vector<Index> active, const KrigingReach& reach) const;

  const TriangleMesh& mesh_;
  const Points& normals_;
  const FaultNetwork& faults_;
  const KrigingOptions& options_;
  KrigingNodes nodes_;
  Points sights_; ///< of each node a place on its own side of all faults
  std::vector<KrigedPick> picks_;
  std::vector<std::vector<Index>> windows_; ///< of nodes, each solved for by itself
};

} // namespace graben::detail
