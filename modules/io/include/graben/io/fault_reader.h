#pragma once

#include "graben/core/export.h"
#include "graben/faults/fault_input.h"

#include <string>
#include <vector>

GRABEN_EXPORT_BEGIN
namespace graben {

/// Reads the faults of a file, in file order; at least one.
///
/// Surfaces: GOCAD TSurf (.ts, one fault per object) and meshes .ply .obj .stl .vtp .vtu .vts .vtk (polygons and grids are split into
/// triangles). A mesh without triangles is points on a fault that nothing joins; so is a PCD.
/// Sticks: IRAP/RMS lines (.pol, each line ended by `999 999 999` or an empty row; the last may lack it), GMT (`>`), GOCAD PLine (.pl),
/// Charisma sticks (INLINE- rows), CPS-3 lines (`->`), IESX, Surfer BLN with z, and tables that tell sticks apart by columns: named in the
/// header (x y z, stick or segment or POLY_ID, node, name of the fault) or found by what the rows hold, as Kingdom, OpendTect, Z-MAP+ and
/// others write them; columns taken are noted. Rows of several names are several faults. Content decides over the extension. Sticks with
/// fewer than two points are dropped with a note. Values are as written: nothing is turned to elevation.
/// \throw IoError if the file cannot be read
/// \throw ParseError if the file holds no fault, is cut short, has an unreadable row or columns that are not certain; names file and line
std::vector<FaultInput> readFaults(const std::string& path);

} // namespace graben
GRABEN_EXPORT_END
