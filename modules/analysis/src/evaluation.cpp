#include "graben/analysis/evaluation.h"

#include "outer_edge.h"

#include "graben/analysis/approximation_error.h"
#include "graben/analysis/bridges.h"
#include "graben/analysis/flipped_triangles.h"
#include "graben/core/errors.h"
#include "graben/features/mean_distance.h"

#include <algorithm>
#include <cmath>

namespace graben {

namespace {

constexpr double kTruthOnFault = 0.25; // of h: faults are meshes, cutoff lines need not lie in them

void checkOptions(const EvaluationOptions& o) {
  const auto check = [](bool good, const char* message) {
    if (!good)
      throw InvalidInputError("evaluating a surface", message);
  };
  check(o.zone_width > 0.0 && std::isfinite(o.zone_width),
        "the width of the zone must be positive");
  check(o.voxel_size >= 0.0 && std::isfinite(o.voxel_size), "the voxel size must not be negative");
  check(o.pick_reach >= 0.0, "the reach of the picks must not be negative");
  check(o.margin >= 0.0 && std::isfinite(o.margin), "the margin must not be negative");
  check(o.on_fault >= 0.0, "the tolerance at the faults must not be negative");
  check(o.samples > 0, "the number of samples must be 1 or more");
}

PickErrors pickErrors(const EvaluationInput& input, const EvaluationOptions& o) {
  const std::vector<double> distance = pickDistances(input.mesh, input.picks, o.threads).distance;
  PickErrors errors;
  errors.all = approximationError(distance, o.threads);
  if (input.faults.empty()) {
    errors.away = errors.all;
    return errors;
  }
  const std::vector<Index> zone = zonePicks(input.picks, input.faults, o.zone_width, o.threads);
  std::vector<Index> away;
  for (std::size_t i = 0, z = 0; i < input.picks.size(); ++i)
    if (z < zone.size() && zone[z] == static_cast<Index>(i))
      ++z;
    else
      away.push_back(static_cast<Index>(i));
  errors.zone = approximationError(distance, zone, o.threads);
  errors.away = approximationError(distance, away, o.threads);
  return errors;
}

double reachOfPicks(const Points& picks, const EvaluationOptions& o) {
  constexpr double kReach = 6.0; // mean distances
  return o.pick_reach > 0.0 ? o.pick_reach : kReach * meanPickDistance(NeighborGrid(picks, 0.0, o.threads), o.threads);
}

FlippedTriangles flippedTriangles(const EvaluationInput& input, unsigned threads) {
  const std::vector<Index> folded = foldedTriangles(input.mesh);
  std::vector<Index> against;
  if (!input.truth.empty())
    against = trianglesAgainst(input.mesh, input.truth, threads);
  std::vector<Index> either;
  std::set_union(folded.begin(), folded.end(), against.begin(), against.end(),
                 std::back_inserter(either));
  return {folded.size(), against.size(), trianglesFacingDown(input.mesh).size(), either};
}

void measureAtFaults(const EvaluationInput& input, const EvaluationOptions& o,
                     SurfaceEvaluation& result) {
  SealOptions seal;
  seal.zone_width = result.voxel_size;
  seal.tolerance = o.on_fault * result.voxel_size;
  seal.threads = o.threads;
  result.bridging_triangles =
      bridgingTriangles(input.mesh, input.faults, seal.tolerance, o.threads);
  result.seal = checkSeal(input.mesh, input.faults, seal);
  if (input.truth.empty())
    return;
  seal.zone_width = o.zone_width;
  seal.truth = &input.truth;
  seal.truth_tolerance = kTruthOnFault * result.voxel_size;
  result.seal_by_truth = checkSeal(input.mesh, input.faults, seal);
}

/// The cutoff lines without those ends of them that lie in the margin.
std::vector<Points> countedCutoffs(const EvaluationInput& input, const EvaluationOptions& options, double voxel_size) {
  std::vector<Points> lines = input.cutoffs;
  if (!(options.margin > 0.0) || input.truth.empty())
    return lines;
  const OuterEdge edge(input.truth, input.faults, kTruthOnFault * voxel_size, options.threads);
  const auto counts = [&](const Vector3& p) { return !edge.isNear(p, options.margin); };
  for (Points& line : lines) {
    line.erase(std::find_if(line.rbegin(), line.rend(), counts).base(), line.end());
    line.erase(line.begin(), std::find_if(line.begin(), line.end(), counts));
  }
  return lines;
}

} // namespace

SurfaceEvaluation evaluateSurface(const EvaluationInput& input, const EvaluationOptions& options) {
  checkOptions(options);
  SurfaceEvaluation result;
  result.topology = checkTopology(input.mesh, options.threads);
  result.quality = triangleQuality(input.mesh, options.threads);
  result.zone_width = options.zone_width;
  result.voxel_size =
      options.voxel_size > 0.0 ? options.voxel_size : result.quality.edge_length_median;
  if (!(result.voxel_size > 0.0))
    throw InvalidInputError("evaluating a surface", "it has no triangle with an area");
  result.flipped = flippedTriangles(input, options.threads);
  if (!input.picks.empty())
    result.picks = pickErrors(input, options);
  if (!input.faults.empty())
    measureAtFaults(input, options, result);
  if (!input.truth.empty()) {
    SurfaceDistanceOptions distance;
    distance.samples = options.samples;
    distance.zone_width = options.zone_width;
    distance.threads = options.threads;
    distance.truth_tolerance = kTruthOnFault * result.voxel_size;
    distance.margin = options.margin;
    if (!input.picks.empty())
      result.pick_reach = distance.pick_reach = reachOfPicks(input.picks, options);
    distance.picks = distance.pick_reach > 0.0 ? &input.picks : nullptr;
    result.truth = surfaceDistances(input.mesh, input.truth, input.faults, distance);
    result.truth_components = checkTopology(input.truth, options.threads).components;
  }
  if (!input.cutoffs.empty())
    result.cutoffs = cutoffDistances(input.mesh, countedCutoffs(input, options, result.voxel_size), {options.samples, options.threads});
  return result;
}

} // namespace graben
