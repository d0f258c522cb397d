#pragma once

#include "graben/surface/cut_mesh.h"

namespace graben {

/// Removes the connected components with fewer than \a least triangles, unless that leaves nothing.
/// \return how many components were removed
std::size_t removeCrumbs(CutMesh& cut, std::size_t least);

/// The triangles turned by more than 75 degrees from the mean of their corners' normals, in rising order: small folds that the fit made.
/// \param[in] cut        with up-to-date vertex normals
/// \param[in] at_border  only those with an edge on the mesh's border
/// \param[in] threads    0: one per processor; the result is the same for every number
std::vector<Index> turnedTriangles(const CutMesh& cut, bool at_border, unsigned threads = 0);

/// Moves the corners of the triangles named, those on no fault, to the mean of their neighbours.
void relaxTriangles(CutMesh& cut, const std::vector<Index>& triangles);

/// Removes the triangles named (in rising order) and gives fans of triangles that are left touching in a vertex a vertex each.
/// \param[in] threads 0: one per processor; the result is the same for every number
void removeTriangles(CutMesh& cut, const std::vector<Index>& triangles, unsigned threads = 0);

} // namespace graben
