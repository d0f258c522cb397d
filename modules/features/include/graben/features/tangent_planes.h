#pragma once

#include "graben/faults/fault_network.h"
#include "graben/features/neighbor_grid.h"

#include <vector>

namespace graben {

/// The tangent plane of every pick: where it is and which way it faces.
struct TangentPlanes {
  Points centres; ///< o: centroid of the pick's neighbours (Hoppe 1992, section 3.2); NaN where
                  ///< there is no plane
  Points normals; ///< n: unit normal; NaN where there is no plane
  std::vector<float> curvature; ///< surface variation, smallest eigenvalue over the sum of all, 0
                                ///< to 1/3; NaN where there is no plane
  std::vector<float> reach;     ///< distance from the pick to the farthest of the neighbours its plane was fitted to, in the picks' units (away
                                ///< from faults and gaps to the K-th nearest point, itself included); NaN where there is no plane
};

struct TangentPlaneOptions {
  std::size_t neighbors =
      15; ///< K: most points a plane is fitted to, the pick itself included as in PCL; 3 or more
  double rho_plus_delta = 0.0; ///< largest step from the neighbours found so far to a new one, in
                               ///< the picks' units; 0: no limit
  double max_distance = 0.0;   ///< farthest neighbour, in the picks' units; 0: no limit
  unsigned threads = 0;        ///< 0: one per processor
};

/// The paper's constrained neighbourhood of one pick: N(p) grows one by one, nearest to p first; a
/// candidate q joins if d(q, N) < rho + delta (minimum distance to the neighbours already found, p
/// included) and, beyond the paper, the segment p q crosses no fault.
///
/// Points that coincide count once. Candidates are the 3 K nearest (up to 27 K where those repeat
/// each other or are mostly cut off, and the rule could still admit more). A pick exactly on a
/// fault takes the side of its nearest neighbour. \param[out] neighbors indices, the pick itself
/// first; empty if the pick is not finite \throw InvalidInputError if there is no such pick or an
/// option is out of range
void growNeighborhood(const NeighborGrid& grid, const FaultNetwork& faults, Index pick,
                      const TangentPlaneOptions& options, std::vector<Index>& neighbors);

/// Fits a plane to each pick's constrained neighbourhood by principal components in double. Normals
/// are not oriented. A pick that is not finite, has fewer than 3 neighbours or whose neighbours are
/// collinear gets NaN. Parallel, the same result for any number of threads; O(n K). \throw
/// InvalidInputError if an option is out of range
TangentPlanes estimateTangentPlanes(const NeighborGrid& grid, const FaultNetwork& faults,
                                    const TangentPlaneOptions& options);

/// The same at any places, for example a subset of the picks: planes fitted to the picks around
/// each place (a pick at that very place included). \return one plane for each place
TangentPlanes estimateTangentPlanesAt(const NeighborGrid& grid, const FaultNetwork& faults,
                                      const TangentPlaneOptions& options, const Points& places);

} // namespace graben
