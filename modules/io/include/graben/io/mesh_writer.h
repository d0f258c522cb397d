#pragma once

#include "graben/core/export.h"
#include "graben/mesh/triangle_mesh.h"

#include <optional>
#include <set>
#include <string>
#include <vector>

GRABEN_EXPORT_BEGIN
namespace graben {

/// What a mesh file says beside the mesh.
struct MeshWriteOptions {
  std::string name = "surface"; ///< object name in .ts, .vtk, .obj and .stl
  /// Which way z grows; .ts only; Unknown is written as Elevation.
  ZPositive z_positive = ZPositive::Unknown;
  std::string xy_unit = "m"; ///< unit of x and y; .ts only
  std::string z_unit = "m";  ///< unit of z; .ts only
  /// .ts only: write piece and scalars as properties (PVRTX lines). Geomodellers show them; strict readers (xtgeo) refuse such a file.
  bool gocad_properties = false;
  /// .ts only: the full dialect: a TFACE per connected piece, properties, border stones and borders. Off: the plain one, which strict readers take.
  bool gocad_full = false;
  /// .ply only: coordinates are float about this origin, which the header states as `comment origin X Y Z` and readMeshes adds again. PCL's readers
  /// take float only. Unset: double.
  std::optional<Vector3> origin = {};
  /// Scalars that are no more than 0 or 1: written as unsigned char where the format has types.
  std::set<std::string> flags = {"extrapolated"};
  unsigned threads = 0; ///< 0: one per processor; the file does not depend on it
};

/// Writes a triangle mesh; the extension of \a path picks the format.
///
/// | extension | coordinates | normals | piece | scalars | form |
/// |---|---|---|---|---|---|
/// | .ply | double, or float about an origin | float | int property | float, flags uchar properties | binary, little endian |
/// | .vtk | double | float | int array | float, flags unsigned char arrays | legacy 4.2, binary |
/// | .vtp | double | float | int array | float, flags UInt8 arrays | XML, binary |
/// | .obj | double (text) | double (text) | one group per run of triangles | - | text |
/// | .stl | float | per triangle | - | - | binary |
/// | .ts  | double (text) | - | property, if asked for | properties, if asked for | GOCAD TSurf, one TFACE; a TFACE per piece, borders in the full dialect |
///
/// Scalars are the mesh's own (TriangleMesh::scalars, any names), `pick_distance` and `extrapolated` among them; readMeshes gives
/// them back. A value that is not finite is written as it is, in .ts as the property's no-data value.
/// Coordinates are written as they are; a text number is the shortest that reads back as the same
/// double. The file appears under its name only when it is complete; on failure nothing is left
/// behind and a former file is kept.
/// \returns sentences for the user on what the format could not hold; empty if nothing was lost
/// \throw InvalidInputError if the extension is unknown (the message lists the formats) or the mesh
///   is not valid
/// \throw WriteError if the file cannot be written
std::vector<std::string> writeMesh(const std::string& path, const TriangleMesh& mesh,
                                   const MeshWriteOptions& options = {});

/// Whole numbers near the middle of points, as an origin for single precision.
Vector3 originFor(const Points& points);

/// Writes points as a PLY without faces. Errors as writeMesh.
/// \param[in] normals one per point, or empty
void writePlyPoints(const std::string& path, const Points& points, const Points& normals = {}, const MeshWriteOptions& options = {});

/// The extensions writeMesh takes, with the dot, in lower case.
const std::vector<std::string>& meshWriteExtensions();

} // namespace graben
GRABEN_EXPORT_END
