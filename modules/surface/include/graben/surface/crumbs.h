#pragma once

#include "graben/surface/cut_mesh.h"

namespace graben {

/// Removes the connected components with fewer than \a least triangles, unless that leaves nothing.
/// \return how many components were removed
std::size_t removeCrumbs(CutMesh& cut, std::size_t least);

/// Moves the corners of the triangles named, those on no fault, to the mean of their neighbours.
void relaxTriangles(CutMesh& cut, const std::vector<Index>& triangles);

/// Removes the triangles named (in rising order) and gives fans of triangles that are left touching in a vertex a vertex each.
void removeTriangles(CutMesh& cut, const std::vector<Index>& triangles);

} // namespace graben
