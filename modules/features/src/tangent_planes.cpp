#include "graben/features/tangent_planes.h"

#include "graben/core/errors.h"
#include "graben/core/threads.h"
#include "neighborhood_grower.h"
#include "plane_fit.h"

#include <cmath>

namespace graben {
namespace {

void check(const NeighborGrid& grid, const TangentPlaneOptions& options) {
  if (options.neighbors < 3)
    throw InvalidInputError(
        "estimating tangent planes",
        "A plane needs 3 neighbours or more; set a larger number of neighbours.");
  if (std::isnan(options.rho_plus_delta) || options.rho_plus_delta < 0.0)
    throw InvalidInputError("estimating tangent planes",
                            "rho + delta must be 0 (no limit) or positive.");
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
  constexpr double NONE = std::numeric_limits<double>::quiet_NaN();
  constexpr std::size_t GRAIN = 1024;
  const Points& points = grid.points();
  TangentPlanes planes;
  planes.centres.assign(points.size(), Vector3::Constant(NONE));
  planes.normals.assign(points.size(), Vector3::Constant(NONE));
  planes.curvature.assign(points.size(), static_cast<float>(NONE));
  const std::vector<Index>& order = grid.order();
  parallelBlocks(order.size(), GRAIN, options.threads, [&](std::size_t begin, std::size_t end) {
    detail::NeighborhoodGrower grower(grid, faults, options);
    std::vector<Index> neighbors;
    for (std::size_t i = begin; i < end; ++i) {
      grower.grow(order[i], neighbors);
      const auto pick = static_cast<std::size_t>(order[i]);
      if (const auto plane = detail::fitPlane(points, neighbors)) {
        planes.centres[pick] = plane->centre;
        planes.normals[pick] = plane->normal;
        planes.curvature[pick] = static_cast<float>(plane->curvature);
      }
    }
  });
  return planes;
}

} // namespace graben
