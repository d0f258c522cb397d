#pragma once

#include "graben/mesh/triangle_mesh.h"

namespace graben::detail {

/// Appends the strip between border vertices, in the direction of their triangles, and \a outer, a
/// further vertex for each of them (the vertex itself where the strip has no width there), wound as
/// the surface. Triangles that would turn their back on the surface or have no area are left out.
/// \param[in] normals of the surface at each edge, one fewer than vertices; any length
/// \return the number of triangles left out
std::size_t addStrip(TriangleMesh& mesh, const std::vector<Index>& inner,
                     const std::vector<Index>& outer, const Points& normals);

} // namespace graben::detail
