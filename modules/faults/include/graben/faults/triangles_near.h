#pragma once

#include "graben/core/export.h"
#include "graben/faults/fault_network.h"

#include <vector>

GRABEN_EXPORT_BEGIN
namespace graben {

/// The triangles whose boxes, \a reach larger on every side, overlap the box of a fault's triangle, in rising order: at least all triangles within the
/// reach of a fault. Fast where triangles that follow each other mostly lie near each other.
/// \param[in] reach 0 or more, unit of the coordinates \param[in] threads 0: one per processor. O(n log m), deterministic. The mesh's indices must be valid.
std::vector<Index> trianglesNear(const FaultNetwork& network, const TriangleMesh& mesh, double reach, unsigned threads = 0);

} // namespace graben
GRABEN_EXPORT_END
