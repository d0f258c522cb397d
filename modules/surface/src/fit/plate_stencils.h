#pragma once

#include "graben/mesh/vertex_corners.h"
#include "graben/surface/cut_mesh.h"

#include <array>
#include <vector>

namespace graben::detail {

/// How the second derivatives of the surface at a vertex follow from the moves of the vertices around it along their normals.
struct PlateStencil {
  std::vector<Index> vertices;                  ///< itself first; none where there are too few around to tell
  std::array<std::vector<double>, 3> weights;   ///< of their moves in h_uu, sqrt(2) h_uv and h_vv, times the root of the vertex's area
  std::array<double, 3> bend{};                 ///< the same as it is now
};

/// The stencils of all vertices, from quadrics through the vertices up to about one and a half edges away on the same piece.
/// \param[in] normals unit normals of the vertices
std::vector<PlateStencil> plateStencils(const TriangleMesh& mesh, const Points& normals, const VertexCorners& corners, unsigned threads);

} // namespace graben::detail
