#pragma once

#include "graben/analysis/statistics.h"
#include "graben/core/export.h"
#include "graben/faults/fault_network.h"

#include <optional>

GRABEN_EXPORT_BEGIN
namespace graben {

struct SurfaceDistanceOptions {
  std::size_t samples = 100000; ///< sample points on each surface, 1 or more
  double zone_width =
      0.0; ///< sample points up to this far from a fault are near, unit of the coordinates
  unsigned threads = 0; ///< 0: one per processor
  /// The picks that the mesh was made from, or null; with them the truth is also measured without what no pick is near to.
  const Points* picks = nullptr;
  double pick_reach = 0.0; ///< how far from all picks the truth still counts then; more than 0
  /// The truth's border lies at a fault up to this far from it. Where it does not, the truth is not known beyond it, and parts of the mesh there are
  /// not counted; 0: all parts are.
  double truth_tolerance = 0.0;
  double margin = 0.0; ///< parts of the truth this near to the part of its border that lies at no fault do not count as missing at the picks
};

/// Distances from one surface to another. The samples are spread evenly over the area, so means and
/// quantiles are area-weighted; max is over the vertices as well.
struct OneWayDistances {
  DistanceStatistics all;
  DistanceStatistics near; ///< within the zone width of a fault
  DistanceStatistics far;
};

struct SurfaceDistances {
  OneWayDistances to_truth;   ///< from the mesh to the truth: what is there and should not be
  double beyond = 0.0;        ///< share of the mesh's area that lies beyond the truth and is not counted
  OneWayDistances from_truth; ///< from the truth to the mesh: what is missing
  std::optional<OneWayDistances> from_truth_at_picks; ///< the same within the picks' reach: without holes in the data
};

/// Distances both ways between a mesh and the true surface; O((n + samples) log n), deterministic.
/// \param[in] network the faults that split near from far; without faults all is far
/// \throw InvalidInputError if a mesh is not valid or has no triangle with an area, or an option is
/// out of range
SurfaceDistances surfaceDistances(const TriangleMesh& mesh, const TriangleMesh& truth,
                                  const FaultNetwork& network = {},
                                  const SurfaceDistanceOptions& options = {});

/// Points spread evenly over the area of a mesh: stratified over the triangles in their order,
/// quasi-random inside. O(count + n), deterministic. \throw InvalidInputError if no triangle has an
/// area
Points sampleSurface(const TriangleMesh& mesh, std::size_t count);

} // namespace graben
GRABEN_EXPORT_END
