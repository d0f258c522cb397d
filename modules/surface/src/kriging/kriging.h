#pragma once

#include "kriging_system.h"

#include "graben/mesh/triangle_bvh.h"

namespace graben::detail {

/// How near to each other the nodes of a surface are.
enum class NodeDensity { Coarse, Fine };

/// One linearisation of a surface that picks hold, about the surface as it is.
class Kriging {
public:
  /// All must outlive this. \param[in] normals unit, of the mesh's vertices, along which these move
  Kriging(const CutMesh& cut, const Points& normals, const VertexCorners& corners, const Points& picks, const FaultNetwork& faults,
          const KrigingOptions& options, NodeDensity density);

  /// Those that hold the surface.
  const KrigedPlaces& picks() const { return pick_places_; }

  /// The moves of all vertices along their normals.
  std::vector<double> moves(const SurfaceCorrelation& correlation) const;

private:
  double nodeSpacing(NodeDensity density) const;
  void placeNodes(const VertexCorners& corners);
  void addPicks(const Points& picks);
  bool addPick(const Vector3& pick, const TriangleBvh& bvh, KrigedPick& made, Vector3& normal) const;
  void makeWindows(std::size_t most_nodes);

  const Vector3& placeOf(std::size_t node) const { return node_places_.place[node]; }
  std::vector<Index> grown(const std::vector<Index>& window) const;
  KrigingSystem systemOf(std::vector<Index> active, bool misties) const;

  const TriangleMesh& mesh_;
  const Points& normals_;
  const FaultNetwork& faults_;
  const KrigingOptions& options_;
  KrigingNodes nodes_;
  KrigedPlaces node_places_;
  KrigedPlaces pick_places_;
  std::vector<KrigedPick> picks_;
  std::vector<std::vector<Index>> windows_; ///< of nodes, each solved for by itself
};

} // namespace graben::detail
