#include "extrapolation.h"

#include "graben/core/threads.h"
#include "graben/surface/viewpoints.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace graben {

namespace {

bool hidden(const FaultNetwork& faults, const Vector3& from, const Vector3& pick) {
  Bounds box;
  box.extend(from);
  box.extend(pick);
  return faults.mayTouch(box) && faults.crosses(from, pick);
}

double distanceToPicks(const Vector3& vertex, const Vector3& viewpoint, const NeighborGrid& picks, const FaultNetwork& faults) {
  const Neighbor nearest = picks.nearestOne(vertex);
  const auto place = [&](const Neighbor& n) { return picks.points()[static_cast<std::size_t>(n.index)]; };
  if (nearest.index < 0 || faults.empty() || !hidden(faults, viewpoint, place(nearest)))
    return std::sqrt(nearest.squared_distance);
  std::vector<Neighbor> candidates;
  std::size_t seen = 1;
  for (std::size_t count = 16; count <= 1024; count *= 4) {
    picks.nearest(vertex, count, candidates);
    for (; seen < candidates.size(); ++seen)
      if (!hidden(faults, viewpoint, place(candidates[seen])))
        return std::sqrt(candidates[seen].squared_distance);
    if (candidates.size() < count)
      break;
  }
  return std::sqrt(candidates.back().squared_distance);
}

double area(const TriangleMesh& mesh, const Triangle& t) {
  const Vector3& a = mesh.vertices[static_cast<std::size_t>(t[0])];
  return 0.5 * (mesh.vertices[static_cast<std::size_t>(t[1])] - a).cross(mesh.vertices[static_cast<std::size_t>(t[2])] - a).norm();
}

} // namespace

Extrapolation markExtrapolation(CutMesh& cut, const NeighborGrid& picks, const FaultNetwork& faults, const ExtrapolationOptions& options) {
  TriangleMesh& mesh = cut.mesh;
  const Viewpoints from(cut);
  std::vector<float>& distance = mesh.scalars["pick_distance"];
  std::vector<float>& extrapolated = mesh.scalars["extrapolated"];
  distance.resize(mesh.vertices.size());
  extrapolated.resize(mesh.vertices.size());
  parallelFor(mesh.vertices.size(), 256, options.threads, [&](std::size_t v) {
    const double d = distanceToPicks(mesh.vertices[v], from.of(static_cast<Index>(v)), picks, faults);
    distance[v] = static_cast<float>(d);
    extrapolated[v] = d > options.limit ? 1.0F : 0.0F;
  });

  Extrapolation result;
  result.limit = options.limit;
  for (std::size_t v = 0; v < distance.size(); ++v) {
    result.vertices += extrapolated[v] > 0.0F ? 1 : 0;
    result.farthest = std::max<double>(result.farthest, distance[v]);
  }
  double whole = 0.0;
  double beyond = 0.0;
  for (const Triangle& t : mesh.triangles) {
    const double size = area(mesh, t);
    whole += size;
    for (const Index v : t)
      beyond += size / 3.0 * extrapolated[static_cast<std::size_t>(v)];
  }
  result.area_share = whole > 0.0 ? beyond / whole : 0.0;
  return result;
}

} // namespace graben
