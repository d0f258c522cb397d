#pragma once

#include "graben/faults/fault_network.h"
#include "graben/mesh/components.h"
#include "graben/mesh/connections.h"
#include "graben/pipeline/reconstruction_report.h"
#include "graben/surface/cut_mesh.h"

namespace graben {

/// A vertex this near to a fault lies on it; in voxels. Where bridges are looked for to remove them and to count them it must be the same.
constexpr double kOnFault = 0.01;

/// The finished surface and what it is measured against, in the local frame.
struct FinishedSurface {
  const CutMesh& cut; ///< with piece labels
  const MeshConnections& connections;
  const Components& components;
  const FaultNetwork& faults;
  const Points& picks;
  const std::vector<Index>& zone; ///< picks near the faults
};

/// Fills in the figures of the finished surface.
/// \return the piece nearest to each pick, -1 where none is within the report's fault reach
std::vector<Index> evaluate(const FinishedSurface& surface, unsigned threads, ReconstructionReport& report);

} // namespace graben
