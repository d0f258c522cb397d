#pragma once

#include "graben/mesh/triangle_mesh.h"

#include <array>
#include <vector>

namespace graben {

/// Where one piece of a horizon meets one fault.
struct CutoffLine {
  Index fault = -1;
  Index piece = -1; ///< piece label of the mesh, -1 where it has none
  Points points;    ///< in the direction of the border: the piece lies to the left, seen from the side its normals point to
};

/// The cutoff lines of a cut mesh: runs of border edges whose two ends lie on the same fault.
/// \param[in] vertex_faults the faults each vertex lies on, {-1, -1} for none (see CutMesh)
/// In the order of the faults, then of their first edge; O(n log n), deterministic.
/// \throw InvalidInputError if vertex_faults has not one entry per vertex
std::vector<CutoffLine> cutoffLines(const TriangleMesh& mesh, const std::vector<std::array<Index, 2>>& vertex_faults);

} // namespace graben
