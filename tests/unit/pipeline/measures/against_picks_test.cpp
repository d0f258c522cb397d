#include "measures/against_picks.h"

#include "graben/mesh/normals.h"

#include <gtest/gtest.h>

#include <numeric>

namespace graben {
namespace {

TEST(AgainstPicks, FindsATriangleThatTheFitFoldedOver) {
  TriangleMesh mesh;
  Points picks;
  for (int row = 0; row < 5; ++row)
    for (int column = 0; column < 5; ++column)
      mesh.vertices.emplace_back(column, row, 0.0);
  picks = mesh.vertices;
  for (Index row = 0; row < 4; ++row)
    for (Index column = 0; column < 4; ++column) {
      const Index a = 5 * row + column;
      mesh.triangles.push_back({a, a + 1, a + 6});
      mesh.triangles.push_back({a, a + 6, a + 5});
    }
  std::vector<Index> all(mesh.triangles.size());
  std::iota(all.begin(), all.end(), 0);
  const NeighborGrid grid(picks);
  const Points up(picks.size(), Vector3::UnitZ());
  computeVertexNormals(mesh, 1);
  EXPECT_TRUE(trianglesAgainstPicks(mesh, all, grid, up, 3.0).empty());

  mesh.vertices[6] = Vector3(2.2, 2.6, 0.0); // (1, 1), past its neighbours
  computeVertexNormals(mesh, 1);
  const std::vector<Index> found = trianglesAgainstPicks(mesh, all, grid, up, 3.0);
  EXPECT_FALSE(found.empty());
  for (const Index t : found)
    EXPECT_LT(areaNormal(mesh, mesh.triangles[static_cast<std::size_t>(t)]).z(), 0.0);
  EXPECT_TRUE(trianglesAgainstPicks(mesh, all, grid, Points(picks.size(), -Vector3::UnitZ()), 1e-3).empty()) << "no pick in reach";
}

} // namespace
} // namespace graben
