#include "graben/mesh/adjacency.h"

#include "unit/mesh/meshes.h"

#include <gmock/gmock.h>

#include <chrono>

namespace graben {
namespace {

using testing::ElementsAre;
using testing::UnorderedElementsAre;

TriangleMesh meshOf(std::size_t vertices, std::vector<Triangle> triangles) {
  TriangleMesh mesh;
  for (std::size_t v = 0; v < vertices; ++v)
    mesh.vertices.emplace_back(static_cast<double>(v), static_cast<double>(v * v), 0.0);
  mesh.triangles = std::move(triangles);
  return mesh;
}

TEST(EdgeAdjacency, FindsTheOtherSideOfAnEdge) {
  const EdgeAdjacency adjacency(meshOf(4, {{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(adjacency.twin(2), 3);
  EXPECT_EQ(adjacency.twin(3), 2);
  for (const Index h : {0, 1, 4, 5})
    EXPECT_TRUE(adjacency.isBorder(h)) << h;
}

TEST(EdgeAdjacency, MarksEdgesWithThreeTrianglesAndEdgesRunTwiceTheSameWay) {
  const EdgeAdjacency three(meshOf(5, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}));
  for (const Index h : {0, 3, 6})
    EXPECT_EQ(three.twin(h), EdgeAdjacency::kNonManifold);
  const EdgeAdjacency same_way(meshOf(4, {{0, 1, 2}, {0, 1, 3}}));
  EXPECT_EQ(same_way.twin(0), EdgeAdjacency::kNonManifold);
  EXPECT_EQ(same_way.twin(3), EdgeAdjacency::kNonManifold);
}

TEST(EdgeAdjacency, TrianglesThatNameAVertexTwiceTakeNoPart) {
  const EdgeAdjacency adjacency(meshOf(3, {{0, 1, 2}, {0, 0, 1}}));
  EXPECT_TRUE(adjacency.isBorder(0));
  EXPECT_EQ(adjacency.twin(4), EdgeAdjacency::kNonManifold);
}

TEST(TwinOf, IsThatOfTheWholeAdjacencyFromEitherEnd) {
  std::vector<TriangleMesh> meshes = {test::gridMesh(5), meshOf(5, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}), meshOf(4, {{0, 1, 2}, {0, 1, 3}}),
                                      meshOf(3, {{0, 1, 2}, {0, 0, 1}}), meshOf(3, {{0, 1, 2}, {0, 2, 1}, {1, 2, 0}})};
  std::mt19937_64 random(3);
  TriangleMesh& tangle = meshes.emplace_back(meshOf(8, {}));
  for (int t = 0; t < 20; ++t)
    tangle.triangles.push_back({static_cast<Index>(random() % 8), static_cast<Index>(random() % 8), static_cast<Index>(random() % 8)});
  for (const TriangleMesh& mesh : meshes) {
    const VertexCorners corners(mesh);
    const EdgeAdjacency adjacency(mesh, corners);
    for (std::size_t h = 0; h < 3 * mesh.triangles.size(); ++h)
      for (const std::size_t end : {h % 3, (h + 1) % 3})
        EXPECT_EQ(twinOf(mesh, corners.of(static_cast<std::size_t>(mesh.triangles[h / 3][end])), static_cast<Index>(h)),
                  adjacency.twin(static_cast<Index>(h)));
  }
}

TEST(EdgeAdjacency, TwinsAreMutualAndRunOppositeWaysOnALargeGrid) {
  const TriangleMesh mesh = test::gridMesh(60);
  const EdgeAdjacency adjacency(mesh);
  Index border = 0;
  for (Index h = 0; h < static_cast<Index>(3 * mesh.triangles.size()); ++h) {
    if (adjacency.isBorder(h)) {
      ++border;
      continue;
    }
    const Index twin = adjacency.twin(h);
    ASSERT_GE(twin, 0);
    ASSERT_EQ(adjacency.twin(twin), h);
    const auto corner = [&mesh](Index half_edge, Index step) {
      return mesh.triangles[half_edge / 3][(half_edge + step) % 3];
    };
    ASSERT_EQ(corner(h, 0), corner(twin, 1));
  }
  EXPECT_EQ(border, 240);
}

TEST(BorderLoops, AnEmptyAndAClosedMeshHaveNone) {
  const TriangleMesh nothing;
  EXPECT_TRUE(borderLoops(nothing, EdgeAdjacency(nothing)).empty());
  const TriangleMesh tetrahedron = meshOf(4, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}});
  EXPECT_TRUE(borderLoops(tetrahedron, EdgeAdjacency(tetrahedron)).empty());
}

TEST(BorderLoops, RunInTheDirectionOfTheTriangles) {
  const TriangleMesh mesh = test::gridMesh(1);
  EXPECT_THAT(borderLoops(mesh, EdgeAdjacency(mesh)), ElementsAre(ElementsAre(0, 1, 3, 2)));
}

TEST(BorderLoops, AHoleIsALoopOfItsOwn) {
  TriangleMesh mesh = test::gridMesh(3);
  mesh.triangles.erase(mesh.triangles.begin() + 8, mesh.triangles.begin() + 10); // the middle cell
  const auto loops = borderLoops(mesh, EdgeAdjacency(mesh));
  ASSERT_EQ(loops.size(), 2U);
  EXPECT_EQ(loops[0].size(), 12U);
  EXPECT_THAT(loops[1], UnorderedElementsAre(5, 6, 9, 10));
}

TEST(BorderLoops, LoopsThatTouchAtABowTieVertexStayApart) {
  const TriangleMesh mesh = meshOf(5, {{0, 1, 2}, {0, 3, 4}});
  EXPECT_THAT(borderLoops(mesh, EdgeAdjacency(mesh)),
              ElementsAre(ElementsAre(0, 1, 2), ElementsAre(0, 3, 4)));
}

TEST(BorderLoops, CloseAlongNonManifoldEdges) {
  const TriangleMesh mesh = meshOf(5, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}});
  EXPECT_THAT(borderLoops(mesh, EdgeAdjacency(mesh)),
              UnorderedElementsAre(UnorderedElementsAre(0, 1, 2), UnorderedElementsAre(0, 1, 3),
                                   UnorderedElementsAre(0, 1, 4)));
}

TEST(EdgeAdjacency, AMillionTrianglesTakeLessThanASecond) {
  const TriangleMesh mesh = test::gridMesh(707);
  const auto start = std::chrono::steady_clock::now();
  const EdgeAdjacency adjacency(mesh);
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
  RecordProperty("seconds", std::to_string(taken.count()));
  EXPECT_TRUE(adjacency.isBorder(0));
  EXPECT_LT(taken.count(), 5.0); // ten times what it takes, so that a busy machine does not fail it
}

} // namespace
} // namespace graben
