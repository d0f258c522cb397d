#pragma once

#include "graben/mesh/triangle_mesh.h"

#include <string>
#include <vector>

namespace graben {

/// What a mesh file says beside the mesh.
struct MeshWriteOptions {
  std::string name = "surface"; ///< object name in .ts, .vtk, .obj and .stl
  /// Which way z grows; .ts only; Unknown is written as Elevation.
  ZPositive z_positive = ZPositive::Unknown;
  std::string xy_unit = "m"; ///< unit of x and y; .ts only
  std::string z_unit = "m";  ///< unit of z; .ts only
};

/// Writes a triangle mesh; the extension of \a path picks the format.
///
/// | extension | coordinates | normals | piece | scalars | form |
/// |---|---|---|---|---|---|
/// | .ply | double | float | int property | float properties | binary, little endian |
/// | .vtk | double | float | int array | float arrays | legacy 4.2, binary |
/// | .vtp | double | float | int array | float arrays | XML, binary |
/// | .obj | double (text) | double (text) | one group per run of triangles | - | text |
/// | .stl | float | per triangle | - | - | binary |
/// | .ts  | double (text) | - | - | - | GOCAD TSurf, one TFACE |
///
/// Coordinates are written as they are; a text number is the shortest that reads back as the same
/// double. The file appears under its name only when it is complete; on failure nothing is left
/// behind and a former file is kept.
/// \returns sentences for the user on what the format could not hold; empty if nothing was lost
/// \throw InvalidInputError if the extension is unknown (the message lists the formats) or the mesh
///   is not valid
/// \throw IoError if the file cannot be written
std::vector<std::string> writeMesh(const std::string& path, const TriangleMesh& mesh,
                                   const MeshWriteOptions& options = {});

/// The extensions writeMesh takes, with the dot, in lower case.
const std::vector<std::string>& meshWriteExtensions();

} // namespace graben
