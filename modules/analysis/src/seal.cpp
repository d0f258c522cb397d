#include "graben/analysis/seal.h"

#include "graben/analysis/statistics.h"
#include "graben/core/errors.h"
#include "graben/core/threads.h"
#include "graben/mesh/adjacency.h"

#include <algorithm>

namespace graben {

namespace {

std::vector<Index> borderVertices(const TriangleMesh& mesh) {
  const EdgeAdjacency adjacency(mesh);
  std::vector<Index> result;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t e = 0; e < 3; ++e)
      if (adjacency.isBorder(static_cast<Index>(3 * t + e))) {
        result.push_back(mesh.triangles[t][e]);
        result.push_back(mesh.triangles[t][(e + 1) % 3]);
      }
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

FaultSeal sealOf(std::vector<double> distances, double tolerance) {
  FaultSeal seal;
  seal.vertices = distances.size();
  if (distances.empty())
    return seal;
  seal.on_fault = static_cast<std::size_t>(std::count_if(
      distances.begin(), distances.end(), [tolerance](double d) { return d <= tolerance; }));
  seal.share = static_cast<double>(seal.on_fault) / static_cast<double>(seal.vertices);
  seal.p50 = quantile(distances, 0.5);
  seal.p95 = quantile(distances, 0.95);
  seal.max = quantile(distances, 1.0);
  return seal;
}

} // namespace

SealReport checkSeal(const TriangleMesh& mesh, const FaultNetwork& network,
                     const SealOptions& options) {
  const std::string stage = "checking the seal";
  if (!(options.zone_width > 0.0) || !(options.tolerance >= 0.0))
    throw InvalidInputError(
        stage, "the width of the zone must be positive and the tolerance not negative");
  validate(mesh, stage);
  const std::vector<Index> border = borderVertices(mesh);
  std::vector<FaultPoint> nearest(border.size());
  parallelFor(border.size(), 256, options.threads, [&](std::size_t i) {
    nearest[i] =
        network.nearest(mesh.vertices[static_cast<std::size_t>(border[i])], options.zone_width);
  });
  std::vector<std::vector<double>> distances(network.size());
  std::vector<double> all;
  for (const FaultPoint& point : nearest)
    if (point.fault >= 0) {
      distances[static_cast<std::size_t>(point.fault)].push_back(point.distance);
      all.push_back(point.distance);
    }
  SealReport report;
  report.all = sealOf(std::move(all), options.tolerance);
  for (std::vector<double>& of_fault : distances)
    report.faults.push_back(sealOf(std::move(of_fault), options.tolerance));
  return report;
}

} // namespace graben
