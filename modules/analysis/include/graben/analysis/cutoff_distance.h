#pragma once

#include "graben/analysis/statistics.h"
#include "graben/core/export.h"
#include "graben/mesh/triangle_mesh.h"

#include <vector>

GRABEN_EXPORT_BEGIN
namespace graben {

struct CutoffDistanceOptions {
  std::size_t samples = 10000; ///< sample points over all lines together, 1 or more
  unsigned threads = 0;        ///< 0: one per processor
};

/// How far true cutoff lines are from where a surface ends.
struct CutoffDistances {
  DistanceStatistics all;
  std::vector<DistanceStatistics> lines; ///< by index of the line
};

/// Distances from cutoff lines (where the true horizon meets a fault) to the nearest border edge of
/// a mesh.
///
/// The samples are spread evenly over the length of all lines, so the figures are weighted by
/// length. Any border edge counts: that of a hole or of the outer edge too.
/// \param[in] lines polylines in the mesh's frame; one without length gives no sample
/// O((n + samples) log n), deterministic.
/// \throw InvalidInputError if the mesh is not valid or has no border, a line's point is not
/// finite, no line has a length, or samples is 0
CutoffDistances cutoffDistances(const TriangleMesh& mesh, const std::vector<Points>& lines,
                                const CutoffDistanceOptions& options = {});

} // namespace graben
GRABEN_EXPORT_END
