#pragma once

#include "graben/features/neighbor_grid.h"

namespace graben {

/// How densely and how exactly a cloud samples its surface, estimated from the picks themselves; all in the picks' units.
struct Sampling {
  double spacing = 0.0; ///< median nearest-neighbour distance (of distinct points)
  double rho = 0.0;     ///< the cloud is rho-dense: no ball of that radius on the surface, away from holes, is empty
  double delta = 0.0;   ///< the cloud is delta-noisy: the largest noise, from the residuals to local planes
  double sigma = 0.0;   ///< standard deviation of the noise across the surface, from residuals to local quadrics
};

/// Estimates spacing, rho, delta and sigma from at most 20,000 picks spread evenly over the cloud's order; O(n) beyond building the grid.
/// \throw InvalidInputError if fewer than three distinct points exist or all are collinear
Sampling estimateSampling(const NeighborGrid& grid, unsigned threads = 0);

} // namespace graben
