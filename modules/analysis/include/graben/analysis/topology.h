#pragma once

#include "graben/core/export.h"
#include "graben/mesh/components.h"
#include "graben/mesh/connections.h"

#include <cstddef>

GRABEN_EXPORT_BEGIN
namespace graben {

/// Components with fewer triangles than this are crumbs.
constexpr std::size_t kCrumbTriangles = 20;

/// What is connected to what in a mesh, and what is wrong with it. Geometry plays no part except in
/// degenerate_triangles.
struct TopologyReport {
  std::size_t vertices = 0;
  std::size_t triangles = 0;
  std::size_t unreferenced_vertices = 0;
  std::size_t non_manifold_edges = 0; ///< edges of three or more triangles
  std::size_t inconsistent_edges = 0; ///< edges two triangles run along in the same direction
  std::size_t non_manifold_vertices =
      0; ///< vertices where several fans of triangles touch that share no edge there
  std::size_t duplicate_triangles = 0; ///< triangles beyond the first with the same three vertices
  /// Triangles that name a vertex twice, whose longest edge is below 1e-12 of the mesh's bounding
  /// diagonal, or whose smallest height is below 1e-10 of their longest edge. Those that name a
  /// vertex twice take no part in the counts of edges and vertices.
  std::size_t degenerate_triangles = 0;
  std::size_t components = 0; ///< joined over shared vertices
  std::size_t crumbs = 0;     ///< components under kCrumbTriangles
  std::size_t border_edges = 0;
  std::size_t border_loops = 0;

  /// How much is wrong: the sum of all counts of faults; crumbs and borders are no faults.
  std::size_t errors() const {
    return unreferenced_vertices + non_manifold_edges + inconsistent_edges + non_manifold_vertices + duplicate_triangles + degenerate_triangles;
  }

  bool ok() const { return errors() == 0; }
};

/// O(n log n). An empty mesh has nothing wrong with it.
/// \throw InvalidInputError if the mesh is not valid (see validate)
/// \param[in] threads 0: one per processor
TopologyReport checkTopology(const TriangleMesh& mesh, unsigned threads = 0);

/// The same for a valid mesh whose connections and components are at hand.
TopologyReport checkTopology(const TriangleMesh& mesh, const MeshConnections& connections, const Components& components, unsigned threads = 0);

} // namespace graben
GRABEN_EXPORT_END
