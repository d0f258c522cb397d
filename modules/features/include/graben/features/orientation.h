#pragma once

#include "graben/features/tangent_planes.h"

namespace graben {

enum class OrientationMethod {
  SpanningTree, ///< Hoppe 1992, section 3.3: along a minimum spanning tree of 1 - |n_i . n_j| over the fault-limited neighbour graph
  UpAxis        ///< every normal is turned to the same side as the up axis
};

struct OrientationOptions {
  OrientationMethod method = OrientationMethod::SpanningTree;
  Vector3 up = Vector3::UnitZ(); ///< UpAxis: the axis; SpanningTree: each component is turned so that its normals agree with it on the whole
  std::size_t neighbors = 10;    ///< SpanningTree: graph edges go to this many nearest picks
  double rho_plus_delta = 0.0;   ///< SpanningTree: longest graph edge; 0: no limit
  unsigned threads = 0;
};

struct OrientationResult {
  std::size_t components = 0;      ///< connected components of the graph (1 for UpAxis)
  std::vector<Index> of_pick;      ///< component of each pick, -1 where it has no normal; empty for UpAxis
};

/// Orients normals consistently, in place; NaN normals stay. SpanningTree falls back on each component's mean: a component whose normals are, summed,
/// against \a up is turned as a whole (a closed object, whose normals sum to nearly nothing, is turned outwards: its topmost pick faces up).
/// Deterministic for any number of threads; O(n k log n).
OrientationResult orientNormals(const NeighborGrid& grid, const FaultNetwork& faults, const OrientationOptions& options, Points& normals);

} // namespace graben
