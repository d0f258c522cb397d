#pragma once

#include "graben/faults/fault_network.h"
#include "graben/pipeline/reconstruction_report.h"
#include "graben/surface/cut_mesh.h"

namespace graben {

/// Fills in the figures of the finished local mesh.
void evaluate(const CutMesh& cut, const FaultNetwork& faults, const Points& picks, const std::vector<Index>& zone, unsigned threads,
              ReconstructionReport& report);

/// The piece nearest to each pick, -1 where none is within \a reach.
std::vector<Index> piecesOfPicks(const CutMesh& cut, const Points& picks, double reach, unsigned threads);

} // namespace graben
