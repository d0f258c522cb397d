#include "graben/surface/nearest_in_sight.h"

#include "graben/core/threads.h"
#include "graben/surface/viewpoints.h"

namespace graben {

namespace {

bool hidden(const FaultNetwork& faults, const Vector3& from, const Vector3& pick) {
  Bounds box;
  box.extend(from);
  box.extend(pick);
  return faults.mayTouch(box) && faults.crosses(from, pick);
}

} // namespace

Neighbor nearestInSight(const Vector3& vertex, const Vector3& viewpoint, const NeighborGrid& picks, const FaultNetwork& faults) {
  const Neighbor nearest = picks.nearestOne(vertex);
  const auto inSight = [&](const Neighbor& pick) { return !hidden(faults, viewpoint, picks.points()[static_cast<std::size_t>(pick.index)]); };
  if (nearest.index < 0 || faults.empty() || inSight(nearest))
    return nearest;
  std::vector<Neighbor> candidates;
  std::size_t seen = 1;
  for (std::size_t count = 16; count <= 1024; count *= 4) {
    picks.nearest(vertex, count, candidates);
    for (; seen < candidates.size(); ++seen)
      if (inSight(candidates[seen]))
        return candidates[seen];
    if (candidates.size() < count)
      break;
  }
  return {-1, candidates.back().squared_distance};
}

std::vector<Index> picksOfVertices(const CutMesh& cut, const VertexCorners& corners, const NeighborGrid& picks, const FaultNetwork& faults,
                                   unsigned threads) {
  constexpr std::size_t kGrain = 512;
  const Viewpoints from(cut, corners);
  std::vector<Index> found(cut.mesh.vertices.size(), -1);
  parallelFor(found.size(), kGrain, threads, [&](std::size_t v) {
    found[v] = nearestInSight(cut.mesh.vertices[v], from.of(static_cast<Index>(v)), picks, faults).index;
  });
  return found;
}

} // namespace graben
