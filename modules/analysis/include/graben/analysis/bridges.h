#pragma once

#include "graben/core/export.h"
#include "graben/faults/fault_network.h"
#include "graben/mesh/vertex_corners.h"

#include <vector>

GRABEN_EXPORT_BEGIN
namespace graben {

/// The triangles that join the two sides of a fault, in rising order; a cut surface has none.
///
/// A triangle is a bridge if
/// - one of its edges runs from one side of a fault to the other: its ends are both farther than \a
/// tolerance from the fault, and the
///   edge crosses it more often one way than the other, at a place farther than \a tolerance from
///   the fault's border; or
/// - it shares an edge that lies on a fault (both ends and the middle within \a tolerance) with a
/// triangle on the fault's other side: a
///   surface snapped to the fault but not cut.
/// So vertices on the fault belong to either side, and a triangle that passes beside the tip is
/// none. Two sides that touch in a single vertex are no bridge here; checkTopology counts such
/// vertices.
///
/// \param[in] tolerance 0 or more, unit of the coordinates; the distance up to which a vertex
/// counts as on the fault \param[in] threads   0: one per processor O(n log m) away from the
/// faults; deterministic. \throw InvalidInputError if the mesh is not valid or the tolerance is
/// negative or NaN
std::vector<Index> bridgingTriangles(const TriangleMesh& mesh, const FaultNetwork& network,
                                     double tolerance, unsigned threads = 0);

/// The same for a valid mesh whose corners are at hand; triangles may have been taken out of it since, by making them name a vertex twice.
std::vector<Index> bridgingTriangles(const TriangleMesh& mesh, const VertexCorners& corners, const FaultNetwork& network, double tolerance,
                                     unsigned threads = 0);

} // namespace graben
GRABEN_EXPORT_END
