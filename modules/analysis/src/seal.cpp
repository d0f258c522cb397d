#include "graben/analysis/seal.h"

#include "border_edges.h"
#include "outer_edge.h"
#include "part_near_faults.h"

#include "graben/analysis/statistics.h"
#include "graben/core/errors.h"
#include "graben/core/sort_unique.h"
#include "graben/core/threads.h"

#include <algorithm>

namespace graben {

namespace {

const char* const kStage = "checking the seal";

std::vector<Index> borderVertices(const TriangleMesh& mesh, const EdgeAdjacency& adjacency) {
  std::vector<Index> result;
  for (const auto& edge : borderEdges(mesh, adjacency))
    result.insert(result.end(), edge.begin(), edge.end());
  sortUnique(result);
  return result;
}

/// Tells the outer edge of the data from borders at a fault, where the truth is known.
class TrueBorder {
public:
  TrueBorder(const SealOptions& options, const FaultNetwork& network)
      : network_(network)
      , tolerance_(options.truth_tolerance) {
    if (options.truth == nullptr)
      return;
    bvh_ = TriangleBvh(borderMesh(*options.truth, options.threads), options.threads);
    ends_ = OuterEdge(*options.truth, network, tolerance_, options.threads).ends();
  }

  /// False too for a vertex off the fault's border that is no nearer to it than its end, where the outer edge begins, is.
  bool endsAtFaultNear(const Vector3& p) const {
    if (bvh_.empty())
      return true;
    const Vector3 nearest = bvh_.nearest(p).point;
    const double off = (p - nearest).norm();
    const auto isEndNear = [&](const Vector3& end) { return (end - nearest).norm() <= off; };
    return network_.nearest(nearest, tolerance_).fault >= 0 && (off <= 1e-6 * tolerance_ || std::none_of(ends_.begin(), ends_.end(), isEndNear));
  }

private:
  const FaultNetwork& network_;
  double tolerance_;
  TriangleBvh bvh_;
  Points ends_; ///< of the outer edge, at faults
};

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
  validate(mesh, kStage, options.threads);
  // Where the part ends and the mesh goes on lies beyond the zone.
  const TriangleMesh part = partNearFaults(mesh, network, options.zone_width, options.threads).mesh;
  return checkSeal(part, EdgeAdjacency(part, options.threads), network, options);
}

SealReport checkSeal(const TriangleMesh& mesh, const EdgeAdjacency& adjacency, const FaultNetwork& network, const SealOptions& options) {
  if (!(options.zone_width > 0.0) || !(options.tolerance >= 0.0))
    throw InvalidInputError(kStage, "the width of the zone must be positive and the tolerance not negative");
  if (options.truth != nullptr)
    validate(*options.truth, kStage, options.threads);
  const std::vector<Index> border = borderVertices(mesh, adjacency);
  const TrueBorder truth(options, network);
  std::vector<FaultPoint> nearest(border.size());
  parallelFor(border.size(), 256, options.threads, [&](std::size_t i) {
    const Vector3& vertex = mesh.vertices[static_cast<std::size_t>(border[i])];
    nearest[i] = network.nearest(vertex, options.zone_width);
    if (nearest[i].fault >= 0 && !truth.endsAtFaultNear(vertex))
      nearest[i].fault = -1;
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
