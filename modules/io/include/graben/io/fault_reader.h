#pragma once

#include "graben/faults/fault_surface.h"
#include "graben/mesh/triangle_mesh.h"

#include <string>
#include <variant>
#include <vector>

namespace graben {

/// One fault as its file has it, in the user's frame.
struct FaultInput {
  std::string name; ///< from the file where it has one, else the file's name without extension
  std::variant<TriangleMesh, std::vector<FaultStick>> geometry;
  ZPositive z_positive = ZPositive::Unknown; ///< what the file says
  std::string source;                        ///< path of the file
  std::vector<std::string> notes; ///< sentences for the user: what was ignored, dropped or assumed
  std::vector<std::string> warnings = {}; ///< sentences for the user: what is probably not as it was meant
};

/// Reads the faults of a file, in file order; at least one.
///
/// Surfaces: GOCAD TSurf (.ts, one fault per object) and triangle meshes .ply .obj .stl .vtp .vtk
/// (polygons are split into triangles). Sticks: IRAP/RMS lines (.pol, each line ended by `999 999
/// 999` or an empty row; the last may lack it), GOCAD PLine (.pl), Charisma sticks (INLINE- rows,
/// one fault per name) and CPS-3 lines (`->`). Content decides over the extension. Sticks with
/// fewer than two points are dropped with a note. Values are as written: nothing is turned to
/// elevation.
/// \throw IoError if the file cannot be read
/// \throw ParseError if the file holds no fault, is cut short or has an unreadable row; names file
///   and line
std::vector<FaultInput> readFaults(const std::string& path);

} // namespace graben
