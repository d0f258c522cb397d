#pragma once

#include "graben/core/export.h"
#include "graben/mesh/adjacency.h"
#include "graben/mesh/vertex_corners.h"

#include <utility>

GRABEN_EXPORT_BEGIN
namespace graben {

/// What hangs on a mesh's triangles alone and serves one stage after the other: it holds until triangles are added, removed or turned round,
/// wherever the vertices move. 26 bytes a triangle.
struct MeshConnections {
  VertexCorners corners;
  EdgeAdjacency adjacency;

  /// O(n); the same for any number of threads (0: one per processor). The mesh's indices must be valid.
  explicit MeshConnections(const TriangleMesh& mesh, unsigned threads = 0)
      : MeshConnections(mesh, VertexCorners(mesh, threads), threads) {}

  /// The same where the mesh's corners are at hand.
  MeshConnections(const TriangleMesh& mesh, VertexCorners at_hand, unsigned threads = 0)
      : corners(std::move(at_hand))
      , adjacency(mesh, corners, threads) {}
};

} // namespace graben
GRABEN_EXPORT_END
