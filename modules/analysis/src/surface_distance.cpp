#include "graben/analysis/surface_distance.h"

#include "outer_edge.h"

#include "graben/core/errors.h"
#include "graben/core/threads.h"
#include "graben/features/neighbor_grid.h"
#include "graben/mesh/normals.h"

#include <algorithm>
#include <cmath>

namespace graben {

namespace {

const char* const kStage = "measuring distances between surfaces";

/// Fractional part of start + k * step: an evenly spread sequence in [0, 1).
double spread(std::size_t k, double step) {
  const double value = 0.5 + static_cast<double>(k) * step;
  return value - std::floor(value);
}

/// The point of a triangle for two numbers in [0, 1), area-preserving.
Vector3 pointIn(const TriangleMesh& mesh, const Triangle& triangle, double u, double v) {
  const double root = std::sqrt(u);
  const auto at = [&](std::size_t i) -> const Vector3& {
    return mesh.vertices[static_cast<std::size_t>(triangle[i])];
  };
  return (1.0 - root) * at(0) + root * (1.0 - v) * at(1) + root * v * at(2);
}

struct Measured {
  std::vector<double> distance;
  std::vector<char> near; ///< 0: far, 1: near, kBeyond: not counted
  std::vector<char> at_picks; ///< empty where it is not asked for
};

constexpr char kBeyond = 3;

/// What one way of measuring is done with; null where there is none.
struct Limits {
  const NeighborGrid* picks = nullptr;
  const OuterEdge* edge = nullptr;   ///< of the target
  const OuterEdge* margin = nullptr; ///< edge of what is measured
};

Measured measure(const Points& points, const TriangleBvh& target, const FaultNetwork& network, const Limits& limits,
                 const SurfaceDistanceOptions& options) {
  Measured result{std::vector<double>(points.size()), std::vector<char>(points.size(), 0), {}};
  result.at_picks.resize(limits.picks != nullptr ? points.size() : 0);
  parallelFor(points.size(), 512, options.threads, [&](std::size_t i) {
    const MeshPoint nearest = target.nearest(points[i]);
    result.distance[i] = nearest.distance;
    result.near[i] = !network.empty() && network.nearest(points[i], options.zone_width).fault >= 0 ? 1 : 0;
    if (limits.edge != nullptr && limits.edge->isBeyond(points[i], nearest))
      result.near[i] = kBeyond;
    if (limits.picks != nullptr)
      result.at_picks[i] = limits.picks->nearestOne(points[i], options.pick_reach).index >= 0 &&
                                   !(limits.margin != nullptr && limits.margin->isNear(points[i], options.margin))
                               ? 1
                               : 0;
  });
  return result;
}

/// \param[in] which 0: far, 1: near, 2: all
std::vector<double> pick(const Measured& measured, int which, bool at_picks) {
  std::vector<double> result;
  for (std::size_t i = 0; i < measured.distance.size(); ++i)
    if (measured.near[i] != kBeyond && (which == 2 || measured.near[i] == which) && (!at_picks || measured.at_picks[i] != 0))
      result.push_back(measured.distance[i]);
  return result;
}

OneWayDistances figuresOf(const Measured& samples, const Measured& vertices, bool at_picks) {
  const auto figures = [&](int which) {
    DistanceStatistics statistics = distanceStatistics(pick(samples, which, at_picks));
    for (const double d : pick(vertices, which, at_picks))
      statistics.max = std::max(statistics.max, d);
    return statistics;
  };
  return {figures(2), figures(1), figures(0)};
}

struct OneWay {
  OneWayDistances all;
  std::optional<OneWayDistances> at_picks; ///< where there are picks
  double beyond = 0.0;                     ///< share of the samples
};

OneWay oneWay(const TriangleMesh& from, const TriangleBvh& target, const FaultNetwork& network, const Limits& limits,
              const SurfaceDistanceOptions& options) {
  const Measured samples = measure(sampleSurface(from, options.samples), target, network, limits, options);
  TriangleMesh used;
  used.vertices = from.vertices;
  used.triangles = from.triangles;
  removeUnreferencedVertices(used);
  const Measured vertices = measure(used.vertices, target, network, limits, options);
  OneWay result{figuresOf(samples, vertices, false), {}, 0.0};
  if (limits.picks != nullptr)
    result.at_picks = figuresOf(samples, vertices, true);
  const auto beyond = std::count(samples.near.begin(), samples.near.end(), kBeyond);
  result.beyond = static_cast<double>(beyond) / static_cast<double>(samples.near.size());
  return result;
}

} // namespace

Points sampleSurface(const TriangleMesh& mesh, std::size_t count) {
  std::vector<double> area_up_to;
  area_up_to.reserve(mesh.triangles.size());
  double area = 0.0;
  for (const Triangle& triangle : mesh.triangles)
    area_up_to.push_back(area += areaNormal(mesh, triangle).norm());
  if (!(area > 0.0) || !std::isfinite(area))
    throw InvalidInputError(kStage, "a surface has no triangle with an area");
  // Steps of the R2 sequence (Roberts 2018): powers of the inverse of the plastic number.
  constexpr double step_u = 0.7548776662466927;
  constexpr double step_v = 0.5698402909980532;
  Points points;
  points.reserve(count);
  std::size_t t = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const double target = area * (static_cast<double>(k) + 0.5) / static_cast<double>(count);
    while (t + 1 < area_up_to.size() && area_up_to[t] < target)
      ++t;
    points.push_back(pointIn(mesh, mesh.triangles[t], spread(k, step_u), spread(k, step_v)));
  }
  return points;
}

SurfaceDistances surfaceDistances(const TriangleMesh& mesh, const TriangleMesh& truth,
                                  const FaultNetwork& network,
                                  const SurfaceDistanceOptions& options) {
  if (options.samples == 0)
    throw InvalidInputError(kStage, "the number of samples must be 1 or more");
  if (!(options.zone_width >= 0.0))
    throw InvalidInputError(kStage, "the width of the zone must not be negative");
  if (options.picks != nullptr && !(options.pick_reach > 0.0))
    throw InvalidInputError(kStage, "the reach of the picks must be positive");
  const TriangleBvh mesh_bvh(mesh, options.threads);
  const TriangleBvh truth_bvh(truth, options.threads);
  std::optional<OuterEdge> edge;
  if (options.truth_tolerance > 0.0 || options.margin > 0.0)
    edge.emplace(truth, network, options.truth_tolerance, options.threads);
  const OneWay to_truth = oneWay(mesh, truth_bvh, network, {nullptr, options.truth_tolerance > 0.0 ? &*edge : nullptr, nullptr}, options);
  const NeighborGrid picks = options.picks != nullptr ? NeighborGrid(*options.picks, 0.0, options.threads) : NeighborGrid();
  const Limits at_picks{options.picks != nullptr ? &picks : nullptr, nullptr, options.margin > 0.0 ? &*edge : nullptr};
  const OneWay from_truth = oneWay(truth, mesh_bvh, network, at_picks, options);
  SurfaceDistances result;
  result.to_truth = to_truth.all;
  result.beyond = to_truth.beyond;
  result.from_truth = from_truth.all;
  result.from_truth_at_picks = from_truth.at_picks;
  return result;
}

} // namespace graben
