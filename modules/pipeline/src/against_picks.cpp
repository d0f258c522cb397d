#include "against_picks.h"

#include "graben/mesh/normals.h"

namespace graben {

std::vector<Index> trianglesAgainstPicks(const CutMesh& cut, const NeighborGrid& grid, const Points& normals, double reach) {
  constexpr double kStandsOut = 0.7; // cosine to the corners' normals: most triangles need no search
  constexpr double kAgainst = 0.17;  // cosine of 80 degrees
  const TriangleMesh& mesh = cut.mesh;
  std::vector<Index> found;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    Vector3 mean = Vector3::Zero();
    Vector3 centre = Vector3::Zero();
    for (const Index v : mesh.triangles[t]) {
      mean += mesh.normals[static_cast<std::size_t>(v)];
      centre += mesh.vertices[static_cast<std::size_t>(v)] / 3.0;
    }
    const Vector3 normal = areaNormal(mesh, mesh.triangles[t]);
    if (normal.dot(mean) >= kStandsOut * normal.norm() * mean.norm())
      continue;
    const Neighbor nearest = grid.nearestOne(centre, reach);
    if (nearest.index >= 0 && normal.dot(normals[static_cast<std::size_t>(nearest.index)]) < kAgainst * normal.norm())
      found.push_back(static_cast<Index>(t));
  }
  return found;
}

} // namespace graben
