#pragma once

#include "graben/core/export.h"
#include "graben/features/neighbor_grid.h"

GRABEN_EXPORT_BEGIN
namespace graben {

/// How densely and how exactly a cloud samples its surface, estimated from the picks themselves;
/// all in the picks' units.
struct Sampling {
  double spacing = 0.0; ///< median nearest-neighbour distance (of distinct points)
  double rho = 0.0; ///< the cloud is rho-dense: no ball of that radius on the surface, away from
                    ///< holes, is empty
  double delta =
      0.0; ///< the cloud is delta-noisy: three standard deviations of the picks about local planes
  double sigma =
      0.0; ///< standard deviation of the noise across the surface, from residuals to local quadrics
};

/// Estimates spacing, rho, delta and sigma from at most 8,000 picks spread evenly over the cloud's
/// order.
///
/// rho comes from the largest empty circles between the picks (corners of their Voronoi cells in
/// the tangent plane), continued to the largest to be expected in a random cloud of that size, and
/// is at least 1.2 steps from pick to pick: 1.2 spacings on a regular square grid, about 2.5 mean
/// spacings in a random cloud of a million; where picks are farther from each other in one direction than in others,
/// as on every few lines of a grid, it is at least 0.6 of how far picks in all directions are. Holes more than two rho wide stay open. Medians and an
/// 80 % quantile are used throughout, so that picks at faults, holes and borders do not count as
/// long as they are the smaller part. O(n); the same result for any number of threads. \param[in]
/// threads 0: one per processor \throw InvalidInputError if fewer than three distinct points exist
/// or all are collinear
Sampling estimateSampling(const NeighborGrid& grid, unsigned threads = 0);

} // namespace graben
GRABEN_EXPORT_END
