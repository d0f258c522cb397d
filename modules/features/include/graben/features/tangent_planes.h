#pragma once

#include "graben/core/export.h"
#include "graben/faults/fault_network.h"
#include "graben/features/neighbor_grid.h"

#include <vector>

GRABEN_EXPORT_BEGIN
namespace graben {

/// The tangent plane of every pick: where it is and which way it faces.
struct TangentPlanes {
  Points centres; ///< o: centroid of the pick's neighbours (Hoppe 1992, section 3.2); NaN where
                  ///< there is no plane
  Points normals; ///< n: unit normal; NaN where there is no plane
  std::vector<float> curvature; ///< surface variation, smallest eigenvalue over the sum of all, 0
                                ///< to 1/3; NaN where there is no plane; empty if not asked for
  std::vector<float> reach;     ///< distance from the pick to the farthest of the neighbours its plane was fitted to, in the picks' units (away
                                ///< from faults and gaps to the K-th nearest point, itself included); NaN where there is no plane
  std::vector<Index> measured;  ///< the planes whose normal was measured, not estimated: sorted indices into the above
};

/// The measured direction of the surface at a pick (from strike and dip).
struct MeasuredNormal {
  Index pick = -1;                  ///< index of the pick
  Vector3 normal = Vector3::Zero(); ///< of any length but 0, to either side
};

struct TangentPlaneOptions {
  std::size_t neighbors =
      15; ///< K: most points a plane is fitted to, the pick itself included as in PCL; 3 or more
  double rho_plus_delta = 0.0; ///< largest step from the neighbours found so far to a new one, in
                               ///< the picks' units; 0: no limit
  double max_distance = 0.0;   ///< farthest neighbour, in the picks' units; 0: no limit
  std::vector<MeasuredNormal> measured; ///< in any order; those of one place are averaged
  double measured_weight = 1.0;         ///< how strongly a measured normal m at distance d turns the normals of picks that have it among
                                        ///< their neighbours, from 0 (not) on; see estimateTangentPlanes()
  bool with_curvature = true;           ///< false: TangentPlanes::curvature stays empty
  unsigned threads = 0;                 ///< 0: one per processor
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
/// collinear gets NaN.
///
/// A pick with a measured normal keeps it, its plane goes through the pick itself. Around it the normal n minimises, with C = sum (q - o)
/// (q - o)^T over the neighbours q,
///   n^T C n - sum w (m . n)^2,  w = measured_weight (trace C / 2) (1 - (d / reach)^2)
/// over the measured normals m among the neighbours. n^T C n grows with the angle a from the normal of the neighbours alone as a^2 trace C / 2
/// (C has two like eigenvalues along the surface), -(m . n)^2 as the squared angle from m: with weight 1 a measurement right at the pick counts
/// as much as all the neighbours together, and none at the neighbourhood's rim, so that normals change without a jump. In terms of errors the
/// best weight is (sigma_n / sigma_m)^2, sigma_n = sigma / sqrt(trace C / 2) being the error of normals estimated from picks with noise sigma,
/// sigma_m that of the measurements, in radians. Faults limit this as they do neighbourhoods.
///
/// Parallel, the same result for any number of threads; O(n K). \throw InvalidInputError if an option is out of range
TangentPlanes estimateTangentPlanes(const NeighborGrid& grid, const FaultNetwork& faults,
                                    const TangentPlaneOptions& options);

/// The same at any places, for example a subset of the picks: planes fitted to the picks around
/// each place (a pick at that very place included). \return one plane for each place
TangentPlanes estimateTangentPlanesAt(const NeighborGrid& grid, const FaultNetwork& faults,
                                      const TangentPlaneOptions& options, const Points& places);

} // namespace graben
GRABEN_EXPORT_END
