#pragma once

#include "graben/core/local_frame.h"
#include "graben/faults/fault_network.h"
#include "graben/filters/wrong_side_picks.h"
#include "graben/mesh/components.h"
#include "graben/mesh/connections.h"
#include "graben/pipeline/reconstruction_report.h"
#include "graben/surface/cut_mesh.h"

#include <optional>

namespace graben {

/// A vertex this near to a fault lies on it; in voxels. Where bridges are looked for to remove them and to count them it must be the same.
constexpr double kOnFault = 0.01;

/// The finished surface in the local frame, with piece labels.
struct FinishedSurface {
  const CutMesh& cut;
  const MeshConnections& connections;
  const Components& components;
  const FaultNetwork& faults;
  std::optional<std::size_t> bridges; ///< triangles that bridge a fault, where they have been counted
};

/// Fills in the figures of the surface itself and of its faults.
void evaluate(const FinishedSurface& surface, unsigned threads, ReconstructionReport& report);

/// All picks, those set aside too.
struct JudgingPicks {
  const Points& points;
  const std::vector<Index>& zone; ///< those near the faults
  std::vector<PickReason>& reasons; ///< those that no surface comes near are marked there
  const LocalFrame& frame;          ///< for places named to the user
};

/// Fills in how many picks take no part, by their reasons.
void countReasons(const std::vector<PickReason>& reasons, ReconstructionReport& report);

/// Where picks lie about the surface; one entry a pick.
struct PicksOnSurface {
  std::vector<Index> piece;    ///< the nearest, -1 where none is within the report's fault reach
  std::vector<float> residual; ///< distance to the surface in z units, positive above it; NaN for a pick that is not finite
};

/// Fills in the picks' distances to the finished mesh, with a warning if it comes near to some of them nowhere, and its field `residual`: for each vertex the
/// mean over the picks not set aside that lie at its triangles, NaN where there are none.
PicksOnSurface evaluatePicks(TriangleMesh& mesh, const JudgingPicks& picks, unsigned threads, ReconstructionReport& report);

} // namespace graben
