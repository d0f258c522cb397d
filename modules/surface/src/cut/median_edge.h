#pragma once

#include "graben/mesh/triangle_mesh.h"

namespace graben {

/// Of the edges of all triangles, in the mesh's units. \param[in] mesh has one triangle or more
double medianEdge(const TriangleMesh& mesh);

} // namespace graben
