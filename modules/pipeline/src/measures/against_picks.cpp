#include "measures/against_picks.h"

#include "graben/mesh/normals.h"

#include <algorithm>

namespace graben {

std::vector<Index> trianglesAgainstPicks(const TriangleMesh& mesh, const std::vector<Index>& suspects, const NeighborGrid& grid, const Points& normals,
                                        double reach) {
  constexpr double kStandsOut = 0.7; // cosine to the corners' normals: most triangles need no search
  constexpr double kAgainst = 0.17;  // cosine of 80 degrees
  const auto isAgainst = [&](Index t) {
    const Triangle& triangle = mesh.triangles[static_cast<std::size_t>(t)];
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
  std::vector<Index> found;
  std::copy_if(suspects.begin(), suspects.end(), std::back_inserter(found), isAgainst);
  return found;
}

} // namespace graben
