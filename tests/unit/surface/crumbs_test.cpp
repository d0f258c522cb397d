#include "graben/surface/crumbs.h"

#include "graben/mesh/normals.h"

#include <gtest/gtest.h>

namespace graben {
namespace {

/// A flat square of 4 x 4 cells of size 1, two triangles each, on no fault.
CutMesh square() {
  CutMesh cut;
  for (int y = 0; y <= 4; ++y)
    for (int x = 0; x <= 4; ++x)
      cut.mesh.vertices.emplace_back(x, y, 0.0);
  for (Index y = 0; y < 4; ++y)
    for (Index x = 0; x < 4; ++x) {
      const Index a = 5 * y + x;
      cut.mesh.triangles.push_back({a, a + 1, a + 6});
      cut.mesh.triangles.push_back({a, a + 6, a + 5});
    }
  cut.vertex_faults.assign(cut.mesh.vertices.size(), {-1, -1});
  return cut;
}

TEST(RemoveTriangles, LeavesNoFansTouchingInAVertex) {
  CutMesh cut = square();
  // Around the middle vertex (12) all but two opposite triangles go.
  std::vector<Index> gone;
  std::vector<Index> around;
  for (std::size_t t = 0; t < cut.mesh.triangles.size(); ++t)
    for (const Index v : cut.mesh.triangles[t])
      if (v == 12)
        around.push_back(static_cast<Index>(t));
  ASSERT_EQ(around.size(), 6U);
  for (const Index t : around)
    if (t != around.front() && t != around.back())
      gone.push_back(t);
  removeTriangles(cut, gone);
  EXPECT_EQ(cut.mesh.triangles.size(), 28U);
  EXPECT_EQ(cut.mesh.vertices.size(), 26U) << "the middle vertex is doubled";
}

TEST(TurnedTriangles, FoldsAtTheBorderAreFoundAndRelaxed) {
  CutMesh cut = square();
  computeVertexNormals(cut.mesh);
  EXPECT_TRUE(turnedTriangles(cut, false).empty());
  cut.mesh.vertices[0] = Vector3(1.6, 1.3, 0.1); // the corner folds over its neighbours
  computeVertexNormals(cut.mesh);
  const std::vector<Index> turned = turnedTriangles(cut, true);
  ASSERT_FALSE(turned.empty());
  for (int round = 0; round < 4; ++round) {
    computeVertexNormals(cut.mesh);
    relaxTriangles(cut, turnedTriangles(cut, true));
  }
  computeVertexNormals(cut.mesh);
  EXPECT_TRUE(turnedTriangles(cut, false).empty());
}

TEST(RelaxTriangles, VerticesOnAFaultStay) {
  CutMesh cut = square();
  cut.vertex_faults[12] = {0, -1};
  cut.mesh.vertices[12].z() = 5.0;
  cut.mesh.vertices[6].z() = 5.0;
  std::vector<Index> all;
  for (std::size_t t = 0; t < cut.mesh.triangles.size(); ++t)
    all.push_back(static_cast<Index>(t));
  relaxTriangles(cut, all);
  EXPECT_EQ(cut.mesh.vertices[12].z(), 5.0);
  EXPECT_LT(cut.mesh.vertices[6].z(), 2.0);
}

} // namespace
} // namespace graben
