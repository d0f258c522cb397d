#pragma once

#include "graben/core/export.h"
#include "graben/mesh/triangle_mesh.h"

GRABEN_EXPORT_BEGIN
namespace graben {

/// The median length of the edges of all triangles, in the mesh's units; one that two triangles share counts twice. Linear in them; thread-safe.
/// \param[in] mesh has one triangle or more
double medianEdge(const TriangleMesh& mesh);

} // namespace graben
GRABEN_EXPORT_END
