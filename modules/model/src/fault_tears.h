#pragma once

#include "cell_fields.h"

#include "graben/faults/fault_network.h"

namespace graben {

/// What a face on a fault is marked with: the fault, and on which of its sides the cell lies that has the face.
inline std::int16_t faultMark(std::size_t fault, bool hanging_wall) { return static_cast<std::int16_t>(2 * fault + (hanging_wall ? 1 : 0)); }
inline Index faultOf(std::int16_t mark) { return mark / 2; }
inline bool inHangingWall(std::int16_t mark) { return mark % 2 != 0; }

/// What a face is marked with behind which cells were left out, for what bounds the model there; edge i of the outline has kOutlineMark - i.
enum BoundaryMark : std::int16_t { kTopMark = -2, kBaseMark = -3, kOutlineMark = -4 };

struct FaultTearOptions {
  Bounds box;
  double size = 0.0; ///< edge of the tetrahedra near faults
  unsigned threads = 0;
};

/// Cuts the mesh along each fault and marks the faces on it (see faultMark): those within its border, and of a branch those on its own side of the
/// fault it ends at. Nodes and vertices of the mesh must be the same.
void cutAlongFaults(TetrahedronMesh& mesh, const FaultNetwork& faults, const FaultTearOptions& options);

} // namespace graben
