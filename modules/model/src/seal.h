#pragma once

#include "labelled_cells.h"

#include "graben/faults/fault_network.h"
#include "graben/model/block_model.h"

namespace graben {

/// The faces between blocks, and those on faults and on the box, as a sealed mesh. \param[out] beyond of each of its vertices, see LabelledCells
SealedMesh sealCells(const LabelledCells& cells, const std::vector<StackHorizon>& horizons, const FaultNetwork& faults, const BlockModelOptions& options,
                     std::vector<double>& beyond);

} // namespace graben
