#pragma once

#include "graben/analysis/statistics.h"
#include "graben/core/export.h"
#include "graben/faults/fault_network.h"

#include <vector>

GRABEN_EXPORT_BEGIN
namespace graben {

/// The nearest point of a surface for each pick, as far as figures need it: 12 bytes a pick.
struct PickDistances {
  std::vector<double> distance; ///< infinite for a pick that is not finite
  std::vector<Index> triangle;  ///< the nearest, -1 for such a pick
};

/// O((n + m) log m), deterministic; fastest for picks, and triangles, that follow each other in space.
/// \throw InvalidInputError if the mesh is not valid or has no triangle
PickDistances pickDistances(const TriangleMesh& mesh, const Points& picks, unsigned threads = 0);

/// E(M, X) from distances at hand: of all picks, or of those \a selection names.
/// \throw InvalidInputError if an index is out of range
DistanceStatistics approximationError(std::vector<double> distances, unsigned threads = 0);
DistanceStatistics approximationError(const std::vector<double>& distances, const std::vector<Index>& selection, unsigned threads = 0);

/// The paper's E(M, X), the mean of d(p, M)^2 over the picks, as mean_square; with the distances'
/// other figures. Picks that are not finite are left out (count says how many were used).
///
/// \param[in] mesh      the surface M
/// \param[in] threads   0: one per processor
/// O((n + m) log m), deterministic. \throw InvalidInputError if the mesh is not valid or has no triangle
DistanceStatistics approximationError(const TriangleMesh& mesh, const Points& picks,
                                      unsigned threads = 0);

/// The same over the picks \a selection names (the paper's X_S, see zonePicks).
/// \throw InvalidInputError also if an index is out of range
DistanceStatistics approximationError(const TriangleMesh& mesh, const Points& picks,
                                      const std::vector<Index>& selection, unsigned threads = 0);

/// The picks within \a width of any fault, in rising order: the paper's X_S.
/// \param[in] width distance to the fault surface, 0 or more, unit of the coordinates
/// \throw InvalidInputError if the width is negative or NaN
std::vector<Index> zonePicks(const Points& picks, const FaultNetwork& network, double width,
                             unsigned threads = 0);

} // namespace graben
GRABEN_EXPORT_END
