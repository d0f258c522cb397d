#pragma once

#include "graben/faults/fault_network.h"

#include <vector>

namespace graben {

/// Some triangles of a mesh as a mesh of their own.
struct MeshPart {
  TriangleMesh mesh;            ///< only the vertices they use, without further arrays
  std::vector<Index> triangles; ///< their indices in the whole mesh, in rising order
};

/// At least all triangles within \a reach of a fault; so of every vertex within the reach all triangles are there. O(n log m), deterministic.
MeshPart partNearFaults(const TriangleMesh& mesh, const FaultNetwork& network, double reach, unsigned threads);

} // namespace graben
