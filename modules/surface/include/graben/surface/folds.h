#pragma once

#include "graben/core/export.h"
#include "graben/faults/fault_network.h"
#include "graben/mesh/vertex_corners.h"
#include "graben/surface/cut_mesh.h"

GRABEN_EXPORT_BEGIN
namespace graben {

/// The triangles whose normal stands out by more than 45 degrees from that of one of their corners, in rising order: few in a good mesh.
///
/// Where one look at the whole mesh is to do for many: what turnedTriangles() finds in the whole mesh is among these, and so is one at least of the two
/// triangles of each edge over which the surface turns by more than 120 degrees.
/// \param[in] mesh     with up-to-date vertex normals
/// \param[in] threads  0: one per processor; the result is the same for every number
std::vector<Index> standingOut(const TriangleMesh& mesh, unsigned threads = 0);

/// Of the triangles named those with an edge on the mesh's border that are turned by more than 75 degrees from the mean of their corners' normals: small
/// folds that the fit made.
/// \param[in] mesh     with up-to-date vertex normals
/// \param[in] corners  of the mesh
std::vector<Index> turnedTriangles(const TriangleMesh& mesh, const VertexCorners& corners, const std::vector<Index>& suspects);

/// Moves the corners of the triangles named, those on no fault, to the mean of their neighbours. \param[in] corners of the mesh
void relaxTriangles(CutMesh& cut, const VertexCorners& corners, const std::vector<Index>& triangles);

/// Moves the corners of the triangles named that lie on one fault alone to the middle between their neighbours along the border there, and back onto the
/// fault: where they have slid past each other, smoothing beside them does not help. \param[in] corners of the mesh
void relaxAlongFaults(CutMesh& cut, const VertexCorners& corners, const std::vector<Index>& triangles, const FaultNetwork& faults);

} // namespace graben
GRABEN_EXPORT_END
