#pragma once

#include "graben/core/export.h"
#include "graben/faults/fault_network.h"
#include "graben/features/neighbor_grid.h"
#include "graben/mesh/vertex_corners.h"
#include "graben/surface/cut_mesh.h"

#include <vector>

GRABEN_EXPORT_BEGIN
namespace graben {

/// The nearest pick that no fault hides from a vertex: the nearest of its own side.
///
/// Looks at the nearest 1024 picks at most. \param[in] viewpoint from where the vertex looks, see Viewpoints
/// \return index -1 where all of them are hidden, with the distance of the last
Neighbor nearestInSight(const Vector3& vertex, const Vector3& viewpoint, const NeighborGrid& picks, const FaultNetwork& faults);

/// The nearest pick of its own side for every vertex of a mesh, -1 where there is none: what a vertex takes colours and other fields from.
/// \param[in] corners of the mesh \param[in] threads 0: one per processor; the result does not depend on it. O(vertices)
std::vector<Index> picksOfVertices(const CutMesh& cut, const VertexCorners& corners, const NeighborGrid& picks, const FaultNetwork& faults,
                                   unsigned threads = 0);

} // namespace graben
GRABEN_EXPORT_END
