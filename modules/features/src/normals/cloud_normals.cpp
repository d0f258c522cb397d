#include "graben/features/cloud_normals.h"

#include "graben/core/errors.h"
#include "graben/core/threads.h"

#include <cmath>

namespace graben {
namespace {

constexpr std::size_t GRAIN = 1024;

void check(const CloudNormalOptions& options) {
  for (const double length : {options.rho, options.delta})
    if (std::isnan(length) || length < 0.0)
      throw InvalidInputError("estimating normals",
                              "rho and delta must be positive, or 0 to estimate them.");
}

void turnTowards(const Vector3& direction, Vector3& normal) {
  if (normal.dot(direction) < 0.0)
    normal = -normal;
}

/// Turns the normal at each place to the side of the nearest oriented pick in sight.
void followPicks(const NeighborGrid& grid, const FaultNetwork& faults, const Points& oriented,
                 const Points& places, unsigned threads, Points& normals) {
  constexpr std::size_t TRIED = 8;
  parallelBlocks(places.size(), GRAIN, threads, [&](std::size_t begin, std::size_t end) {
    std::vector<Neighbor> found;
    for (std::size_t i = begin; i < end; ++i) {
      if (!normals[i].allFinite())
        continue;
      grid.nearest(places[i], TRIED, found);
      for (const Neighbor& neighbor : found) {
        const auto pick = static_cast<std::size_t>(neighbor.index);
        const bool hidden =
            neighbor.squared_distance > 0.0 && faults.crosses(places[i], grid.points()[pick]);
        if (!oriented[pick].allFinite() || hidden)
          continue;
        turnTowards(oriented[pick], normals[i]);
        break;
      }
    }
  });
}

void orientAlongTree(const NeighborGrid& grid, const FaultNetwork& faults,
                     const CloudNormalOptions& options, const TangentPlaneOptions& plane_options,
                     const Points* places, CloudNormals& result) {
  OrientationOptions orientation;
  orientation.up = options.up;
  orientation.rho_plus_delta = plane_options.rho_plus_delta;
  orientation.threads = plane_options.threads;
  if (places == nullptr) {
    orientNormals(grid, faults, orientation, result.planes.normals);
    return;
  }
  Points oriented = estimateTangentPlanes(grid, faults, plane_options).normals;
  orientNormals(grid, faults, orientation, oriented);
  followPicks(grid, faults, oriented, *places, plane_options.threads, result.planes.normals);
}

} // namespace

CloudNormals estimateCloudNormals(const Points& surface, const FaultNetwork& faults,
                                  const CloudNormalOptions& options, const Points* places) {
  check(options);
  const NeighborGrid grid(surface, 0.0, options.planes.threads);
  CloudNormals result;
  result.rho = options.rho;
  result.delta = options.delta;
  if (options.rho == 0.0 || options.delta == 0.0) {
    const Sampling sampling = estimateSampling(grid, options.planes.threads);
    result.rho = options.rho > 0.0 ? options.rho : sampling.rho;
    result.delta = options.delta > 0.0 ? options.delta : sampling.delta;
  }
  TangentPlaneOptions plane_options = options.planes;
  plane_options.rho_plus_delta = result.rho + result.delta;
  result.planes = places == nullptr ? estimateTangentPlanes(grid, faults, plane_options)
                                    : estimateTangentPlanesAt(grid, faults, plane_options, *places);
  if (options.orientation == NormalOrientation::SpanningTree) {
    orientAlongTree(grid, faults, options, plane_options, places, result);
    return result;
  }
  const Points& at = places == nullptr ? surface : *places;
  const bool up = options.orientation == NormalOrientation::UpAxis;
  parallelFor(at.size(), GRAIN, options.planes.threads, [&](std::size_t i) {
    turnTowards(up ? options.up : Vector3(options.viewpoint - at[i]), result.planes.normals[i]);
  });
  return result;
}

} // namespace graben
