#pragma once

#include "graben/core/export.h"
#include "graben/mesh/vertex_corners.h"

#include <vector>

GRABEN_EXPORT_BEGIN
namespace graben {

/// Which triangles meet at each edge. Edge e of triangle t runs from vertex e to vertex (e + 1) % 3
/// and has the index 3 t + e. Triangles that name a vertex twice take no part; their half-edges are
/// kNonManifold. The mesh's indices must be valid.
class EdgeAdjacency {
public:
  static constexpr Index kBorder = -1;      ///< only one triangle has this edge
  static constexpr Index kNonManifold = -2; ///< three or more have it, or two in the same direction

  /// O(n log n) or better; the same for any number of threads (0: one per processor).
  explicit EdgeAdjacency(const TriangleMesh& mesh, unsigned threads = 0);

  /// The same where the mesh's corners are at hand.
  EdgeAdjacency(const TriangleMesh& mesh, const VertexCorners& corners, unsigned threads = 0);

  /// The half-edge on the other side of half-edge 3 t + e, or kBorder, or kNonManifold.
  Index twin(Index half_edge) const { return twin_[static_cast<std::size_t>(half_edge)]; }
  bool isBorder(Index half_edge) const { return twin(half_edge) == kBorder; }

private:
  std::vector<Index> twin_;
};

/// EdgeAdjacency::twin() of a single half-edge, where few are asked for: found among the corners at either end of the edge, and as the triangles are by
/// now, should some of those corners' triangles have changed since.
Index twinOf(const TriangleMesh& mesh, VertexCorners::Range corners_at_an_end, Index half_edge);

/// Closed loops of border half-edges as vertex lists, each in the direction of its triangles; O(n),
/// deterministic. At a vertex where several loops touch, each loop keeps to its own fan of
/// triangles; where a border runs into a non-manifold edge, the loop follows that edge on the side
/// of its own triangles.
std::vector<std::vector<Index>> borderLoops(const TriangleMesh& mesh,
                                            const EdgeAdjacency& adjacency);

} // namespace graben
GRABEN_EXPORT_END
