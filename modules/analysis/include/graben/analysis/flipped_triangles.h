#pragma once

#include "graben/core/export.h"
#include "graben/mesh/vertex_corners.h"

#include <vector>

GRABEN_EXPORT_BEGIN
namespace graben {

/// A fold is an edge over which the surface turns by more than this, degrees.
constexpr double kFoldAngle = 120.0;

/// The triangles to blame for folds, in rising order; a surface that nowhere turns back on itself
/// has none.
///
/// A fold is an edge of two consistently wound triangles whose normals differ by more than
/// kFoldAngle. Each fold blames one triangle: the one that agrees less with the mean normal
/// (weighted by area) of all triangles at the edge's two ends. So a single flipped triangle counts
/// as one, not with its three neighbours. Triangles without an area take no part. Edges whose two
/// triangles are wound against each other are TopologyReport::inconsistent_edges, not folds.
/// O(n log n), deterministic.
/// \throw InvalidInputError if the mesh is not valid
/// \param[in] threads 0: one per processor
std::vector<Index> foldedTriangles(const TriangleMesh& mesh, unsigned threads = 0);

/// The same for the folds that some triangles of a valid mesh have an edge at: those named and triangles next to them. O(suspects log suspects)
/// \param[in] corners of the mesh, before triangles were made to name a vertex twice or since
std::vector<Index> foldedTriangles(const TriangleMesh& mesh, const VertexCorners& corners, const std::vector<Index>& suspects);

/// The triangles that face away from the true surface, in rising order: their normal and that of
/// the nearest true triangle differ by more than 90 degrees.
///
/// Which way a whole file is wound says nothing: each component of the truth is turned so that its
/// mean normal is up, and where most of the mesh faces away, the rest is what is returned. So a
/// mesh with one piece up and one down is found out. O(n log n), deterministic.
/// \param[in] truth   a horizon in the mesh's frame (z up)
/// \param[in] threads 0: one per processor
/// \throw InvalidInputError if a mesh is not valid or the truth has no triangles
std::vector<Index> trianglesAgainst(const TriangleMesh& mesh, const TriangleMesh& truth,
                                    unsigned threads = 0);

/// The same for a horizon without truth: the triangles whose normal has a negative z, or, where
/// most have, the others. A horizon that is folded over has some by right. O(n)
std::vector<Index> trianglesFacingDown(const TriangleMesh& mesh);

} // namespace graben
GRABEN_EXPORT_END
