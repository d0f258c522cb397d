#pragma once

#include "graben/core/export.h"
#include "graben/faults/fault_network.h"
#include "graben/mesh/adjacency.h"

#include <vector>

GRABEN_EXPORT_BEGIN
namespace graben {

struct SealOptions {
  double zone_width = 0.0; ///< border vertices farther than this from every fault are the outer
                           ///< edge and not counted; more than 0
  double tolerance = 0.0;  ///< a border vertex up to this far from its fault lies on it; 0 or more
  /// The true surface, or null. With it only border vertices are counted whose nearest point of the
  /// truth's border lies on a fault and not beside its end, so that a wide zone does not take in the outer edge.
  const TriangleMesh* truth = nullptr;
  double truth_tolerance = 0.0; ///< the truth's border lies on a fault up to this far from it
  unsigned threads = 0;         ///< 0: one per processor
};

/// How well borders are sealed to a fault: distances of the border vertices to it, unit of the
/// coordinates.
struct FaultSeal {
  std::size_t vertices = 0; ///< border vertices in the zone whose nearest fault this is
  std::size_t on_fault = 0; ///< of these, within the tolerance
  double share = 0.0;       ///< on_fault / vertices; 0 where there are none
  double p50 = 0.0;
  double p95 = 0.0;
  double max = 0.0;
};

struct SealReport {
  FaultSeal all;
  std::vector<FaultSeal> faults; ///< by index in the network
};

/// Border vertices (of edges with one triangle) near the faults. Where the outer edge of the data
/// runs into a fault, the few vertices of it that lie in the zone are counted too. O(n log m),
/// deterministic. \throw InvalidInputError if the mesh is not valid or an option is out of range
SealReport checkSeal(const TriangleMesh& mesh, const FaultNetwork& network,
                     const SealOptions& options);

/// The same for a valid mesh whose adjacency is at hand.
SealReport checkSeal(const TriangleMesh& mesh, const EdgeAdjacency& adjacency, const FaultNetwork& network, const SealOptions& options);

} // namespace graben
GRABEN_EXPORT_END
