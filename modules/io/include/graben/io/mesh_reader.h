#pragma once

#include "graben/core/export.h"
#include "graben/mesh/triangle_mesh.h"

#include <string>
#include <vector>

GRABEN_EXPORT_BEGIN
namespace graben {

/// A triangle mesh as its file has it, in the user's frame.
struct MeshInput {
  std::string name; ///< from the file where it has one, else the file's name without extension
  TriangleMesh mesh;
  ZPositive z_positive = ZPositive::Unknown; ///< what the file says
  std::vector<std::string> notes; ///< sentences for the user: what was ignored, dropped or assumed
  std::vector<std::string> warnings = {}; ///< sentences for the user: what is probably not as it was meant
};

/// Reads the triangle meshes of a .ply, .vtk, .vtp, .vtu, .vts, .obj, .stl or .ts file; content decides over
/// the extension. Grids are split into triangles; cells of a .vtu that are no polygons are ignored.
///
/// A GOCAD file gives one mesh per TSurf, any other file one mesh. Polygons with more than three
/// corners are split into a fan. Normals, the label `piece` and further numeric vertex fields (as
/// scalars, whatever their type) are kept where the format has them; what
/// a GOCAD property calls no data is NaN. Vertices of .stl that are equal to the last bit become one.
/// Triangles with a corner that is not finite are dropped with a note.
/// \throw IoError if the file cannot be read
/// \throw ParseError if the file is no mesh, is cut short, or a triangle names a vertex that does
///   not exist
std::vector<MeshInput> readMeshes(const std::string& path);

/// All meshes of a file as one. Several parts of a GOCAD file (TFACE, TSurf) become pieces 0, 1,
/// ... in file order.
/// \param[out] warnings gets those of all meshes too, unless null
TriangleMesh readMesh(const std::string& path, std::vector<std::string>* warnings = nullptr);

} // namespace graben
GRABEN_EXPORT_END
