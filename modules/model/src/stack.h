#pragma once

#include "horizon_heights.h"

#include "graben/model/block_model.h"

namespace graben {

/// Horizons that never cross, as fields of the nodes.
struct Stack {
  std::vector<double> above_first;             ///< how far each node lies above the first horizon
  std::vector<std::vector<double>> thickness;  ///< of the layer over each further horizon, not below zero; [0] is empty
  std::vector<std::vector<float>> beyond;      ///< see HorizonHeights
};

/// Sorts out where horizons meet: by their relations, and layers thinner than min_thickness are absent. Fills in what is told of crossings.
/// \throw InvalidInputError if a conformable horizon lies clearly above the one over it; names the place
Stack stackHorizons(const TetrahedronMesh& mesh, const NodeGraph& graph, const std::vector<StackHorizon>& horizons, std::vector<HorizonHeights> heights,
                    const BlockModelOptions& options, BlockModel& model);

} // namespace graben
