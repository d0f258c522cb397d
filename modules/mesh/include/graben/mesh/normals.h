#pragma once

#include "graben/core/export.h"
#include "graben/mesh/triangle_mesh.h"
#include "graben/mesh/vertex_corners.h"

GRABEN_EXPORT_BEGIN
namespace graben {

/// Twice the area of a triangle times its unit normal (zero for a degenerate one).
Vector3 areaNormal(const TriangleMesh& mesh, const Triangle& triangle);

/// Fills mesh.normals with angle-weighted vertex normals; (0,0,1) at a vertex without a proper
/// triangle.
/// \param[in] threads 0: one per processor
void computeVertexNormals(TriangleMesh& mesh, unsigned threads = 0);

/// The same where the mesh's corners are at hand.
void computeVertexNormals(TriangleMesh& mesh, const VertexCorners& corners, unsigned threads = 0);

/// The same for the vertices named alone, each once; the other normals stay. mesh.normals must have its length.
void updateVertexNormals(TriangleMesh& mesh, const VertexCorners& corners, const std::vector<Index>& vertices, unsigned threads = 0);

} // namespace graben
GRABEN_EXPORT_END
