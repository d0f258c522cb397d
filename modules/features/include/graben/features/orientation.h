#pragma once

#include "graben/core/export.h"
#include "graben/features/tangent_planes.h"

GRABEN_EXPORT_BEGIN
namespace graben {

enum class OrientationMethod {
  SpanningTree, ///< Hoppe 1992, section 3.3: along a minimum spanning tree of 1 - |n_i . n_j| over
                ///< the fault-limited neighbour graph
  UpAxis        ///< every normal is turned to the same side as the up axis
};

struct OrientationOptions {
  OrientationMethod method = OrientationMethod::SpanningTree;
  Vector3 up = Vector3::UnitZ(); ///< UpAxis: the axis; SpanningTree: each component is turned so
                                 ///< that its normals agree with it on the whole
  std::size_t neighbors = 10;    ///< SpanningTree: graph edges go to this many nearest picks
  double rho_plus_delta = 0.0;   ///< SpanningTree: longest graph edge; 0: no limit
  bool components = false;       ///< SpanningTree: whether the components are wanted in the result, at the cost of the graph where the up axis
                                 ///< alone decides
  unsigned threads = 0;          ///< 0: one per processor
};

struct OrientationResult {
  std::size_t components = 0; ///< connected components of the graph (1 for UpAxis); 0 if they were not asked for
  std::vector<Index> of_pick; ///< component of each pick, -1 where it has no normal; empty for UpAxis, and if not asked for
};

/// Orients normals consistently, in place; NaN normals stay as they are.
///
/// SpanningTree: within a component normals agree along the tree; then each component is turned as
/// a whole if the mean of its normals is against \a up. A component whose mean normal is shorter
/// than 0.3 is taken to be a closed object and is turned outwards.
///
/// No graph is made where the axis tells as much: where normals are within 45 degrees of it, but for one in a hundred, and each of these has mostly
/// such normals within rho + delta, whose side it takes. That is so on any horizon but one with overturned folds; noise that throws over single
/// normals does no harm.
///
/// Elsewhere the graph's edges are joined in one parallel pass (where the normals of all picks within rho + delta of a few dozen neighbouring
/// ones are within 45 degrees of one line, these are joined with all of them; components so near to each other are then turned as one, unless
/// they were asked for); the tree itself is made only in components where edges contradict each other
/// (about 80 bytes a pick there, else 20).
///
/// The same result for any number of threads; O(n k log n), where the up axis decides O(n). \param[in,out] normals one for each of the grid's points
/// \throw InvalidInputError if the number of normals or an option is out of range
OrientationResult orientNormals(const NeighborGrid& grid, const FaultNetwork& faults,
                                const OrientationOptions& options, Points& normals);

} // namespace graben
GRABEN_EXPORT_END
