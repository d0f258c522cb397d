#pragma once

#include "graben/core/export.h"
#include "graben/mesh/triangle_mesh.h"

GRABEN_EXPORT_BEGIN
namespace graben {

/// Connected components of a mesh, joined over shared vertices; numbered by falling triangle count,
/// then by first triangle.
struct Components {
  std::vector<Index> of_vertex;            ///< component of each vertex, -1 if no triangle uses it
  std::vector<Index> of_triangle;          ///< component of each triangle
  std::vector<std::size_t> triangle_count; ///< triangles in each component, falling
};

/// O(vertices + triangles), deterministic. \param[in] threads 0: one per processor
Components connectedComponents(const TriangleMesh& mesh, unsigned threads = 0);

/// Writes the component of every vertex into mesh.piece.
/// \throw InvalidInputError if there is a vertex no triangle uses (see removeUnreferencedVertices)
/// \param[in] threads 0: one per processor
Components labelPieces(TriangleMesh& mesh, unsigned threads = 0);

/// One mesh per component, with all per-vertex arrays.
std::vector<TriangleMesh> splitComponents(const TriangleMesh& mesh, const Components& components);

} // namespace graben
GRABEN_EXPORT_END
