#include "graben/features/tangent_planes.h"

#include "graben/core/errors.h"
#include "graben/core/threads.h"
#include "neighborhood_grower.h"
#include "plane_fit.h"

#include <cmath>

namespace graben {
namespace {

constexpr std::size_t GRAIN = 1024;

TangentPlanes noPlanes(std::size_t count) {
  constexpr double NONE = std::numeric_limits<double>::quiet_NaN();
  TangentPlanes planes;
  planes.centres.assign(count, Vector3::Constant(NONE));
  planes.normals.assign(count, Vector3::Constant(NONE));
  planes.curvature.assign(count, static_cast<float>(NONE));
  planes.reach.assign(count, static_cast<float>(NONE));
  return planes;
}

/// Fits plane number \a i, of the given place, to the points given by index.
void fit(const Points& points, const std::vector<Index>& neighbors, const Vector3& place, std::size_t i, TangentPlanes& planes) {
  const std::optional<detail::FittedPlane> plane = detail::fitPlane(points, neighbors);
  if (!plane)
    return;
  double farthest = 0.0;
  for (const Index n : neighbors)
    farthest = std::max(farthest, (points[static_cast<std::size_t>(n)] - place).squaredNorm());
  planes.centres[i] = plane->centre;
  planes.normals[i] = plane->normal;
  planes.curvature[i] = static_cast<float>(plane->curvature);
  planes.reach[i] = static_cast<float>(std::sqrt(farthest));
}

void check(const NeighborGrid& grid, const TangentPlaneOptions& options) {
  if (options.neighbors < 3)
    throw InvalidInputError(
        "estimating tangent planes",
        "A plane needs 3 neighbours or more; set a larger number of neighbours.");
  if (std::isnan(options.rho_plus_delta) || options.rho_plus_delta < 0.0)
    throw InvalidInputError("estimating tangent planes",
                            "rho + delta must be 0 (no limit) or positive.");
  if (std::isnan(options.max_distance) || options.max_distance < 0.0)
    throw InvalidInputError("estimating tangent planes",
                            "The farthest neighbour's distance must be 0 (no limit) or positive.");
  if (grid.points().size() > static_cast<std::size_t>(std::numeric_limits<Index>::max()))
    throw InvalidInputError("estimating tangent planes",
                            "The cloud has more points than a 32-bit index counts.");
}

} // namespace

void growNeighborhood(const NeighborGrid& grid, const FaultNetwork& faults, Index pick,
                      const TangentPlaneOptions& options, std::vector<Index>& neighbors) {
  check(grid, options);
  if (pick < 0 || static_cast<std::size_t>(pick) >= grid.points().size())
    throw InvalidInputError("finding neighbours",
                            "There is no pick number " + std::to_string(pick) + ".");
  detail::NeighborhoodGrower(grid, faults, options).grow(pick, neighbors);
}

TangentPlanes estimateTangentPlanes(const NeighborGrid& grid, const FaultNetwork& faults,
                                    const TangentPlaneOptions& options) {
  check(grid, options);
  TangentPlanes planes = noPlanes(grid.points().size());
  const std::vector<Index>& order = grid.order();
  parallelBlocks(order.size(), GRAIN, options.threads, [&](std::size_t begin, std::size_t end) {
    detail::NeighborhoodGrower grower(grid, faults, options);
    std::vector<Index> neighbors;
    for (std::size_t i = begin; i < end; ++i) {
      grower.grow(order[i], neighbors);
      const auto pick = static_cast<std::size_t>(order[i]);
      fit(grid.points(), neighbors, grid.points()[pick], pick, planes);
    }
  });
  return planes;
}

TangentPlanes estimateTangentPlanesAt(const NeighborGrid& grid, const FaultNetwork& faults,
                                      const TangentPlaneOptions& options, const Points& places) {
  check(grid, options);
  TangentPlanes planes = noPlanes(places.size());
  parallelBlocks(places.size(), GRAIN, options.threads, [&](std::size_t begin, std::size_t end) {
    detail::NeighborhoodGrower grower(grid, faults, options);
    std::vector<Index> neighbors;
    for (std::size_t i = begin; i < end; ++i) {
      grower.growAt(places[i], neighbors);
      fit(grid.points(), neighbors, places[i], i, planes);
    }
  });
  return planes;
}

} // namespace graben
