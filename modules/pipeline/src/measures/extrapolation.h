#pragma once

#include "graben/features/neighbor_grid.h"
#include "graben/mesh/vertex_corners.h"
#include "graben/pipeline/reconstruction_report.h"
#include "graben/surface/cut_mesh.h"

namespace graben {

struct ExtrapolationOptions {
  double limit = 0.0;   ///< farther than this from the nearest pick of its own side a vertex is extrapolated
  unsigned threads = 0; ///< 0: one per processor
};

/// Gives each vertex the scalars pick_distance and extrapolated, see ReconstructionResult::mesh.
/// Where faults hide the nearest thousand picks from a vertex, it gets the distance of the last of them.
/// \param[in] corners of the cut mesh
Extrapolation markExtrapolation(CutMesh& cut, const VertexCorners& corners, const NeighborGrid& picks, const FaultNetwork& faults,
                                const ExtrapolationOptions& options);

} // namespace graben
