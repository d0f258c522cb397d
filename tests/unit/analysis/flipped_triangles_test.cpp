#include "graben/analysis/flipped_triangles.h"

#include "graben/core/errors.h"
#include "graben/mesh/normals.h"
#include "unit/mesh/meshes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace graben {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

/// A flat grid with one inner vertex pulled over its neighbours, so that triangles beyond it turn
/// over.
TriangleMesh pulledOver() {
  TriangleMesh mesh = test::gridMesh(6);
  mesh.vertices[3 * 7 + 3] = {4.6, 3.2, 0.01};
  return mesh;
}

TEST(FoldedTriangles, FlatAndRoofedSurfacesHaveNone) {
  TriangleMesh mesh = test::gridMesh(6);
  EXPECT_THAT(foldedTriangles(mesh), IsEmpty());
  for (Vector3& v : mesh.vertices)
    v.z() = -std::abs(v.x() - 3.0); // a roof of 90 degrees
  EXPECT_THAT(foldedTriangles(mesh), IsEmpty());
  for (Vector3& v : mesh.vertices)
    v.z() *= 3.0; // 143 degrees
  EXPECT_THAT(foldedTriangles(mesh), SizeIs(12 / 2));
}

TEST(FoldedTriangles, BlamesTheFlippedNotTheirNeighbours) {
  const TriangleMesh mesh = pulledOver();
  const std::vector<Index> folded = foldedTriangles(mesh);
  std::vector<Index> down;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (areaNormal(mesh, mesh.triangles[t]).z() < 0.0)
      down.push_back(static_cast<Index>(t));
  ASSERT_FALSE(down.empty());
  EXPECT_EQ(folded, down);
  EXPECT_EQ(trianglesFacingDown(mesh), down);
}

TEST(FoldedTriangles, DoNotDependOnWhichWayTheMeshFaces) {
  TriangleMesh mesh = pulledOver();
  const std::vector<Index> folded = foldedTriangles(mesh);
  flipOrientation(mesh);
  EXPECT_EQ(foldedTriangles(mesh), folded);
  EXPECT_EQ(trianglesFacingDown(mesh), folded);
}

TEST(FoldedTriangles, TrianglesWithoutAreaTakeNoPart) {
  TriangleMesh mesh = test::gridMesh(2);
  mesh.vertices[4] = mesh.vertices[3];
  EXPECT_THAT(foldedTriangles(mesh), IsEmpty());
  EXPECT_THAT(trianglesFacingDown(mesh), IsEmpty());
  EXPECT_THAT(foldedTriangles({}), IsEmpty());
}

TEST(TrianglesAgainst, FindsThePieceThatFacesTheOtherWay) {
  TriangleMesh mesh = test::gridMesh(4);
  TriangleMesh small = test::gridMesh(2, 1.0, 10.0);
  TriangleMesh truth = test::gridMesh(4);
  append(truth, small);
  flipOrientation(small);
  append(mesh, small);
  const std::vector<Index> against = trianglesAgainst(mesh, truth);
  EXPECT_THAT(against, ElementsAre(32, 33, 34, 35, 36, 37, 38, 39));
  EXPECT_EQ(trianglesFacingDown(mesh), against);
  EXPECT_THAT(foldedTriangles(mesh), IsEmpty());
  // How the files as a whole are wound makes no difference.
  flipOrientation(mesh);
  EXPECT_EQ(trianglesAgainst(mesh, truth), against);
  flipOrientation(truth);
  EXPECT_EQ(trianglesAgainst(mesh, truth, 4), against);
  TriangleMesh mixed = test::gridMesh(4); // nor how its parts are
  append(mixed, small);
  EXPECT_EQ(trianglesAgainst(mesh, mixed), against);
}

TEST(TrianglesAgainst, RefusesAnEmptyTruth) {
  EXPECT_THROW(trianglesAgainst(test::gridMesh(2), {}), InvalidInputError);
}

} // namespace
} // namespace graben
