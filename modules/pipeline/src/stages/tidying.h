#pragma once

#include "graben/faults/fault_network.h"
#include "graben/features/neighbor_grid.h"
#include "graben/mesh/vertex_corners.h"
#include "graben/surface/cut_mesh.h"

namespace graben {

/// What tells whether a triangle is in order.
struct TidyingInput {
  const NeighborGrid& grid;
  const Points& pick_normals; ///< of the grid's picks
  const FaultNetwork& faults;
  double pick_reach = 0.0; ///< picks farther than this say nothing of a triangle
  double on_fault = 0.0;   ///< a vertex this near to a fault lies on it
  std::size_t crumb = 0;   ///< components with fewer triangles go
};

/// What was removed.
struct TidyingResult {
  std::size_t folds = 0;
  std::size_t bridges = 0;
  std::size_t crumbs = 0; ///< components that were left too small
};

/// Smooths away triangles that are folded over or, near faults, turned against the picks, and removes those that stay so or reach over a fault.
///
/// The whole mesh is looked at once; then only around what was moved. Not more than four rounds of smoothing, vertices on faults staying in the first
/// two.
/// \param[in,out] cut      has its normals afterwards
/// \param[in,out] corners  of the mesh, before and after
/// \param[in] threads 0: one per processor; the result is the same for every number
TidyingResult tidy(CutMesh& cut, VertexCorners& corners, const TidyingInput& input, unsigned threads);

} // namespace graben
