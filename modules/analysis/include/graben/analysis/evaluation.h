#pragma once

#include "graben/analysis/cutoff_distance.h"
#include "graben/analysis/seal.h"
#include "graben/analysis/surface_distance.h"
#include "graben/analysis/topology.h"
#include "graben/analysis/triangle_quality.h"
#include "graben/core/export.h"

#include <optional>

GRABEN_EXPORT_BEGIN
namespace graben {

/// What a surface is measured against, all in one local frame (z up); empty: not measured.
struct EvaluationInput {
  TriangleMesh mesh;
  Points picks;
  FaultNetwork faults;
  TriangleMesh truth;
  std::vector<Points> cutoffs; ///< true cutoff lines
};

struct EvaluationOptions {
  double zone_width =
      300.0;               ///< near a fault is what lies within this distance of it, in x, y units
  double voxel_size = 0.0; ///< h, the measure for tolerances at the faults, in x, y units; 0: the
                           ///< mesh's median edge length
  double on_fault = 0.01;  ///< a vertex up to this share of h from a fault lies on it
  /// The truth counts as missing only within this distance of a pick, x, y units; 0: six mean distances from pick to pick, as far as a
  /// reconstruction carries a surface on by default. Without picks all counts.
  double pick_reach = 0.0;
  /// What lies this near to the part of the truth's border that is at no fault, cutoff lines too, does not count as missing either, x, y units.
  double margin = 0.0;
  std::size_t samples = 100000; ///< sample points on each surface, and over all cutoff lines
  unsigned threads = 0;         ///< 0: one per processor
};

/// E(M, X) over the picks, by their distance from the faults.
struct PickErrors {
  DistanceStatistics all;
  DistanceStatistics zone; ///< the paper's X_S: within the zone's width of a fault
  DistanceStatistics away;
};

struct FlippedTriangles {
  std::size_t folded = 0;       ///< see foldedTriangles
  std::size_t against = 0;      ///< see trianglesAgainst; 0 without truth
  std::size_t facing_down = 0;  ///< see trianglesFacingDown
  std::vector<Index> triangles; ///< folded or against the truth, in rising order
};

/// All figures of a surface. What needs an input that was not given is empty.
struct SurfaceEvaluation {
  double voxel_size = 0.0; ///< h as used
  double zone_width = 0.0;
  TopologyReport topology;
  TriangleQuality quality;
  FlippedTriangles flipped;
  std::optional<PickErrors> picks;
  std::optional<std::vector<Index>> bridging_triangles; ///< see bridgingTriangles
  std::optional<SealReport> seal;                       ///< border vertices within h of a fault
  std::optional<SurfaceDistances> truth;
  double pick_reach = 0.0; ///< as used for the truth; 0 without picks
  std::size_t truth_components = 0; ///< pieces there should be
  std::optional<SealReport>
      seal_by_truth; ///< border vertices in the whole zone where the truth ends at a fault
  std::optional<CutoffDistances> cutoffs;

  /// True if the topology is ok and no triangle joins the sides of a fault.
  bool ok() const { return topology.ok() && (!bridging_triangles || bridging_triangles->empty()); }
};

/// Measures a surface; deterministic, the same for every number of threads.
/// \throw InvalidInputError if the mesh has no triangle with an area, a mesh is not valid, or an
/// option is out of range
SurfaceEvaluation evaluateSurface(const EvaluationInput& input,
                                  const EvaluationOptions& options = {});

} // namespace graben
GRABEN_EXPORT_END
