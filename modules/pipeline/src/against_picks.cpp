#include "against_picks.h"

#include "graben/core/threads.h"
#include "graben/mesh/normals.h"

namespace graben {

std::vector<Index> trianglesAgainstPicks(const CutMesh& cut, const NeighborGrid& grid, const Points& normals, double reach, unsigned threads) {
  constexpr double kStandsOut = 0.7; // cosine to the corners' normals: most triangles need no search
  constexpr double kAgainst = 0.17;  // cosine of 80 degrees
  constexpr std::size_t kGrain = 1 << 13;
  const TriangleMesh& mesh = cut.mesh;
  const auto isAgainst = [&](const Triangle& triangle) {
    Vector3 mean = Vector3::Zero();
    for (const Index v : triangle)
      mean += mesh.normals[static_cast<std::size_t>(v)];
    const Vector3 normal = areaNormal(mesh, triangle);
    if (normal.dot(mean) >= kStandsOut * normal.norm() * mean.norm())
      return false;
    Vector3 centre = Vector3::Zero();
    for (const Index v : triangle)
      centre += mesh.vertices[static_cast<std::size_t>(v)] / 3.0;
    const Neighbor nearest = grid.nearestOne(centre, reach);
    return nearest.index >= 0 && normal.dot(normals[static_cast<std::size_t>(nearest.index)]) < kAgainst * normal.norm();
  };
  std::vector<std::vector<Index>> blocks((mesh.triangles.size() + kGrain - 1) / kGrain);
  parallelFor(mesh.triangles.size(), kGrain, threads, [&](std::size_t t) {
    if (isAgainst(mesh.triangles[t]))
      blocks[t / kGrain].push_back(static_cast<Index>(t));
  });
  std::vector<Index> found;
  for (const std::vector<Index>& block : blocks)
    found.insert(found.end(), block.begin(), block.end());
  return found;
}

} // namespace graben
