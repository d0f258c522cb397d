#pragma once

#include "graben/mesh/tetrahedron_mesh.h"

#include <functional>

namespace graben {

/// Cells that are told apart by blocks; marks are faultMark().
struct LabelledCells {
  TetrahedronMesh mesh; ///< nodes and vertices are the same again
  std::vector<Index> layer;
  std::vector<Index> block;
  std::vector<double> beyond; ///< of each vertex: how far, in plan, the horizon there was carried on; see HorizonHeights
  Index blocks = 0;

  double volume(std::size_t cell) const;
};

/// Leaves out the cells that are not \a kept and marks the faces that they leave open with \a mark of the cell left out.
void keepCells(TetrahedronMesh& mesh, const std::vector<std::uint8_t>& kept, const std::function<std::int16_t(std::size_t cell)>& mark, unsigned threads);

/// Numbers what is connected within a layer without passing a marked face, in the order of its first cell.
void labelBlocks(LabelledCells& cells, const CellNeighbors& neighbors);

/// Gives blocks smaller than \a volume to the neighbour they share most area with, in the same layer's order where they can.
/// \return how many
std::size_t joinSlivers(LabelledCells& cells, const CellNeighbors& neighbors, double volume);

} // namespace graben
