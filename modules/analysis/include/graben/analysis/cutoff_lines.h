#pragma once

#include "graben/core/export.h"
#include "graben/faults/fault_network.h"
#include "graben/mesh/adjacency.h"

#include <array>
#include <vector>

GRABEN_EXPORT_BEGIN
namespace graben {

/// Where one piece of a horizon meets one side of a fault.
struct CutoffLine {
  Index fault = -1;
  Index piece = -1; ///< piece label of the mesh, -1 where it has none
  int side = 0;     ///< -1: the footwall's, +1: the hanging wall's, 0: not asked for
  std::vector<Index> vertices; ///< of the mesh, one for each point
  std::vector<float> pick_distance; ///< of each point where the mesh has a scalar of that name, else empty
  Points points;    ///< in the direction of the border: the piece lies to the left, seen from the side its normals point to
};

/// The cutoff lines of a cut mesh: runs of border edges whose two ends lie on the same fault.
/// \param[in] vertex_faults the faults each vertex lies on, {-1, -1} for none (see CutMesh)
/// \param[in] faults        in the mesh's frame, to tell the fault's sides apart: lines then end at a tip, where the border changes side; null: not asked
/// In the order of the faults, then the footwall before the hanging wall, then of their first edge; O(n log n), deterministic.
/// \throw InvalidInputError if vertex_faults has not one entry per vertex
std::vector<CutoffLine> cutoffLines(const TriangleMesh& mesh, const std::vector<std::array<Index, 2>>& vertex_faults,
                                    const FaultNetwork* faults = nullptr);

/// The same where the mesh's adjacency is at hand. \param[in] threads 0: one per processor
std::vector<CutoffLine> cutoffLines(const TriangleMesh& mesh, const std::vector<std::array<Index, 2>>& vertex_faults, const EdgeAdjacency& adjacency,
                                    const FaultNetwork* faults = nullptr, unsigned threads = 0);

} // namespace graben
GRABEN_EXPORT_END
