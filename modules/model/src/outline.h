#pragma once

#include "graben/mesh/tetrahedron_mesh.h"
#include "graben/model/block_model.h"

namespace graben {

/// The upright walls along the outline, from below the box to above it; empty where there is no outline.
TriangleMesh outlineWalls(const BlockModelOptions& options);

/// Cuts the mesh along the outline's walls, where its tetrahedra are of the options' size, and leaves out what lies outside. Nodes and vertices of the mesh
/// must be the same, and are again. \throw InvalidInputError if nothing is left
void cutToOutline(TetrahedronMesh& mesh, const BlockModelOptions& options);

} // namespace graben
