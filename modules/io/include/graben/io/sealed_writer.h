#pragma once

#include "graben/core/export.h"
#include "graben/io/mesh_writer.h"
#include "graben/mesh/sealed_mesh.h"

#include <string>

GRABEN_EXPORT_BEGIN
namespace graben {

/// Writes a sealed mesh for gmsh: format 4.1, double precision text, a discrete entity for each corner, line and patch, and a physical group for each
/// surface (`horizon TopA`, `fault F1`, `wall west`).
///
/// Beside it, with the extension .geo, what makes volumes of it: one for each block with its name as physical group, internal surfaces embedded.
/// `gmsh -3 NAME.geo` meshes them all, conforming.
/// \throw IoError if a file cannot be written
void writeGmsh(const std::string& path, const SealedMesh& mesh);

/// Writes a sealed mesh as GOCAD Model3d (.ml): surfaces, each with its patches as faces, and a region for each block. Errors as writeGmsh.
void writeModel3d(const std::string& path, const SealedMesh& mesh, const MeshWriteOptions& options);

/// Writes a ParaView multiblock file (.vtm) and, in a folder of the same name, one .vtp for each block and each surface. Errors as writeGmsh.
void writeMultiblock(const std::string& path, const SealedMesh& mesh);

} // namespace graben
GRABEN_EXPORT_END
