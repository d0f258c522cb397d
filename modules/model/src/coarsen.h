#pragma once

#include "labelled_cells.h"

#include "graben/mesh/bounds.h"

namespace graben {

struct CoarsenOptions {
  Bounds box;
  double size = 0.0; ///< wanted edge of the triangles between blocks
};

/// Makes the faces between blocks well shaped: short edges collapse and vertices shift along their surface, as long as every tetrahedron around stays
/// positive (exact predicates), so that surfaces can neither cross nor open. Vertices stay on their lines and surfaces to within a few hundredths of the
/// size, corners where they are. Deterministic. \return edges collapsed
std::size_t coarsen(LabelledCells& cells, const CellNeighbors& neighbors, const CoarsenOptions& options);

} // namespace graben
