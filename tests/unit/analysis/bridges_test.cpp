#include "graben/analysis/bridges.h"

#include "graben/core/errors.h"
#include "unit/analysis/walls.h"
#include "unit/mesh/meshes.h"

#include <gmock/gmock.h>

#include <algorithm>

namespace graben {
namespace {

constexpr double kTolerance = 1e-6;

/// The 10 x 10 grid cut along x = 5 up to y = \a tip: the triangles to the right have vertices of
/// their own there.
TriangleMesh cutGrid(double tip) {
  TriangleMesh mesh = test::gridMesh(10);
  const Points original = mesh.vertices;
  for (std::size_t v = 0; v < original.size(); ++v) {
    if (original[v].x() != 5.0 || original[v].y() >= tip)
      continue;
    const auto twin = static_cast<Index>(mesh.vertices.size());
    mesh.vertices.push_back(original[v]);
    for (Triangle& t : mesh.triangles)
      if (std::any_of(t.begin(), t.end(), [&](Index i) {
            return mesh.vertices[static_cast<std::size_t>(i)].x() > 5.0;
          }))
        std::replace(t.begin(), t.end(), static_cast<Index>(v), twin);
  }
  return mesh;
}

/// Vertices of the cut at x = 5 that belong to the left part get moved.
void moveLeftCut(TriangleMesh& mesh, const Vector3& by) {
  for (std::size_t v = 0; v < 121; ++v)
    if (mesh.vertices[v].x() == 5.0)
      mesh.vertices[v] += by;
}

TEST(Bridges, AnUncutMeshHasThemAllAlongTheFault) {
  const auto found =
      bridgingTriangles(test::gridMesh(10), test::network(test::wall(5.5, -1, 11)), kTolerance);
  ASSERT_EQ(found.size(), 20U);
  for (const Index t : found)
    EXPECT_EQ(t / 2 % 10, 5); // the column of cells the fault passes through
}

TEST(Bridges, AFaultThatEndsInsideHasThemUpToItsTip) {
  const auto found =
      bridgingTriangles(test::gridMesh(10), test::network(test::wall(5.5, -1, 4.5)), kTolerance);
  EXPECT_THAT(found, testing::ElementsAre(10, 11, 30, 31, 50, 51, 70, 71, 90));
}

TEST(Bridges, AMeshSnappedToTheFaultButNotCutIsFullOfThem) {
  const auto found =
      bridgingTriangles(test::gridMesh(10), test::network(test::wall(5, -1, 11)), kTolerance);
  EXPECT_EQ(found.size(), 20U);
}

TEST(Bridges, ACutMeshHasNone) {
  const FaultNetwork fault = test::network(test::wall(5, -1, 11));
  TriangleMesh mesh = cutGrid(100);
  EXPECT_TRUE(bridgingTriangles(mesh, fault, kTolerance).empty());
  moveLeftCut(mesh, {0.5e-6, 0, 3}); // a throw, and borders off by less than the tolerance
  EXPECT_TRUE(bridgingTriangles(mesh, fault, kTolerance).empty());
}

TEST(Bridges, AMeshCutUpToTheTipHasNone) {
  EXPECT_TRUE(
      bridgingTriangles(cutGrid(4), test::network(test::wall(5, -1, 4)), kTolerance).empty());
  // Tip inside an edge: the one edge of the mesh it runs into is the border's own.
  EXPECT_TRUE(
      bridgingTriangles(cutGrid(5), test::network(test::wall(5, -1, 4.5)), kTolerance).empty());
}

TEST(Bridges, ACutThatStopsShortOfTheTipLeavesTwo) {
  EXPECT_EQ(bridgingTriangles(cutGrid(4), test::network(test::wall(5, -1, 5)), kTolerance).size(),
            2U);
}

TEST(Bridges, BordersBeyondTheFaultCount) {
  TriangleMesh mesh = cutGrid(100);
  moveLeftCut(mesh, {0.1, 0, 0});
  EXPECT_EQ(bridgingTriangles(mesh, test::network(test::wall(5, -1, 11)), kTolerance).size(), 20U);
}

TEST(Bridges, AnEdgeThatRunsThroughAFoldAndBackJoinsNothing) {
  TriangleMesh roof; // a fault folded along x = 5, z = 1; both limbs reach below the horizon
  roof.vertices = {{3, -1, -1}, {3, 11, -1}, {5, 11, 1}, {5, -1, 1}, {7, 11, -1}, {7, -1, -1}};
  roof.triangles = {{0, 3, 2}, {0, 2, 1}, {3, 5, 4}, {3, 4, 2}};
  const FaultNetwork fault = test::network(FaultSurface::fromMesh("fold", roof));
  TriangleMesh mesh;
  mesh.vertices = {{2, 3, 0.5}, {8, 3, 0.5}, {5, 6, 2}};
  mesh.triangles = {{0, 1, 2}};
  EXPECT_TRUE(bridgingTriangles(mesh, fault, kTolerance).empty());
  mesh.vertices[1].x() = 5; // under the roof
  EXPECT_EQ(bridgingTriangles(mesh, fault, kTolerance).size(), 1U);
}

TEST(Bridges, ADippingFaultWithAReverseOverlap) {
  // The fault dips 45 degrees to the right through x = 5 at z = 0; the left sheet lies 2 lower and
  // the right one reaches over it.
  TriangleMesh plane;
  plane.vertices = {{-5, -1, 10}, {-5, 11, 10}, {15, 11, -10}, {15, -1, -10}};
  plane.triangles = {{0, 1, 2}, {0, 2, 3}};
  const FaultNetwork fault = test::network(FaultSurface::fromMesh("reverse", plane));
  TriangleMesh mesh = cutGrid(100);
  const auto onto_fault = [](double x, double lift) { return Vector3(x - lift, 0, lift); };
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    Vector3& p = mesh.vertices[v];
    const bool left = v < 121 && p.x() <= 5.0;
    p += onto_fault(0, left ? -2.0 : 2.0); // along the fault: it stays where it is
  }
  EXPECT_TRUE(bridgingTriangles(mesh, fault, kTolerance).empty());
  mesh.triangles.push_back({60 - 1, 60 + 1, 72}); // from one sheet to the other
  EXPECT_EQ(bridgingTriangles(mesh, fault, kTolerance).size(), 1U);
}

TEST(Bridges, TrianglesTakenOutOfAMeshWhoseCornersAreAtHandJoinNothing) {
  const FaultNetwork fault = test::network(test::wall(5, -1, 11));
  TriangleMesh mesh = test::gridMesh(10);
  const VertexCorners corners(mesh);
  const std::vector<Index> all = bridgingTriangles(mesh, fault, kTolerance);
  EXPECT_EQ(bridgingTriangles(mesh, corners, fault, kTolerance), all);
  Triangle& taken = mesh.triangles[static_cast<std::size_t>(all[4])];
  taken = {taken[0], taken[0], taken[0]};
  EXPECT_EQ(bridgingTriangles(mesh, corners, fault, kTolerance).size(), all.size() - 2); // and the one beyond the seam
  EXPECT_EQ(bridgingTriangles(mesh, fault, kTolerance).size(), all.size() - 2);
}

TEST(Bridges, WithoutFaultsThereAreNoneAndThreadsDoNotMatter) {
  EXPECT_TRUE(bridgingTriangles(test::gridMesh(10), FaultNetwork(), 0.0).empty());
  const FaultNetwork fault = test::network(test::wall(50.3, -1, 101), test::wall(70.1, 10, 90));
  const TriangleMesh mesh = test::gridMesh(100);
  EXPECT_EQ(bridgingTriangles(mesh, fault, 0.0, 1), bridgingTriangles(mesh, fault, 0.0, 4));
  EXPECT_THROW(bridgingTriangles(mesh, fault, -1.0), InvalidInputError);
}

} // namespace
} // namespace graben
