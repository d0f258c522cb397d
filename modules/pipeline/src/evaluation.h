#pragma once

#include "graben/faults/fault_network.h"
#include "graben/pipeline/reconstruction_report.h"
#include "graben/surface/cut_mesh.h"

namespace graben {

/// A vertex this near to a fault lies on it; in voxels. Where bridges are looked for to remove them and to count them it must be the same.
constexpr double kOnFault = 0.01;

/// Fills in the figures of the finished local mesh, which must have piece labels.
/// \return the piece nearest to each pick, -1 where none is within the report's fault reach
std::vector<Index> evaluate(const CutMesh& cut, const FaultNetwork& faults, const Points& picks, const std::vector<Index>& zone,
                            unsigned threads, ReconstructionReport& report);

} // namespace graben
