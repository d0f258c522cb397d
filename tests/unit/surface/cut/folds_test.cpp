#include "graben/surface/folds.h"

#include "graben/analysis/flipped_triangles.h"
#include "graben/mesh/normals.h"
#include "unit/surface/cut_square.h"

#include <gtest/gtest.h>

#include <numeric>

namespace graben {
namespace {

using test::square;

/// With folds here and there.
CutMesh crumpled(std::uint64_t seed) {
  CutMesh cut = square(20);
  std::mt19937_64 random(seed);
  for (Vector3& v : cut.mesh.vertices)
    v += test::randomPoint(random, -0.7, 0.7);
  computeVertexNormals(cut.mesh);
  return cut;
}

std::vector<Index> all(const TriangleMesh& mesh) {
  std::vector<Index> triangles(mesh.triangles.size());
  std::iota(triangles.begin(), triangles.end(), 0);
  return triangles;
}

TEST(TurnedTriangles, FoldsAtTheBorderAreFoundAndRelaxed) {
  CutMesh cut = square(4);
  const VertexCorners corners(cut.mesh);
  const auto turned = [&] {
    computeVertexNormals(cut.mesh);
    return turnedTriangles(cut.mesh, corners, all(cut.mesh));
  };
  EXPECT_TRUE(turned().empty());
  cut.mesh.vertices[0] = Vector3(1.6, 1.3, 0.1); // the corner folds over its neighbours
  ASSERT_FALSE(turned().empty());
  for (int round = 0; round < 4; ++round)
    relaxTriangles(cut, corners, turned());
  EXPECT_TRUE(turned().empty());
}

TEST(TurnedTriangles, InsideTheMeshDoNotCount) {
  CutMesh cut = square(6);
  cut.mesh.vertices[3 * 7 + 3] = {4.6, 3.2, 0.01};
  computeVertexNormals(cut.mesh);
  EXPECT_FALSE(foldedTriangles(cut.mesh).empty());
  EXPECT_TRUE(turnedTriangles(cut.mesh, VertexCorners(cut.mesh), all(cut.mesh)).empty());
}

TEST(StandingOut, AFlatMeshHasNone) {
  CutMesh cut = square(4);
  computeVertexNormals(cut.mesh);
  EXPECT_TRUE(standingOut(cut.mesh).empty());
}

TEST(StandingOut, NoFoldIsMissedByLookingAtThoseAlone) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const CutMesh cut = crumpled(seed);
    const VertexCorners corners(cut.mesh);
    const std::vector<Index> suspects = standingOut(cut.mesh, 1);
    EXPECT_EQ(standingOut(cut.mesh, 3), suspects);
    EXPECT_LT(suspects.size(), cut.mesh.triangles.size());
    const std::vector<Index> folded = foldedTriangles(cut.mesh);
    EXPECT_FALSE(folded.empty());
    EXPECT_EQ(foldedTriangles(cut.mesh, corners, suspects), folded);
    const std::vector<Index> turned = turnedTriangles(cut.mesh, corners, all(cut.mesh));
    EXPECT_FALSE(turned.empty());
    EXPECT_EQ(turnedTriangles(cut.mesh, corners, suspects), turned);
  }
}

TEST(RelaxTriangles, VerticesOnAFaultStay) {
  CutMesh cut = square(4);
  cut.vertex_faults[12] = {0, -1};
  cut.mesh.vertices[12].z() = 5.0;
  cut.mesh.vertices[6].z() = 5.0;
  relaxTriangles(cut, VertexCorners(cut.mesh), all(cut.mesh));
  EXPECT_EQ(cut.mesh.vertices[12].z(), 5.0);
  EXPECT_LT(cut.mesh.vertices[6].z(), 2.0);
}

TEST(RelaxAlongFaults, VerticesThatHaveSlidPastEachOtherComeApart) {
  CutMesh cut = square(4);
  for (const std::size_t v : {0U, 1U, 2U, 3U, 4U})
    cut.vertex_faults[v] = {0, -1}; // the border at y = 0
  cut.vertex_faults[4] = {0, 1};
  std::swap(cut.mesh.vertices[1], cut.mesh.vertices[2]);
  cut.mesh.vertices[6].z() = 1.0;
  TriangleMesh wall;
  wall.vertices = {{-9, 0.25, -9}, {9, 0.25, -9}, {9, 0.25, 9}, {-9, 0.25, 9}};
  wall.triangles = {{0, 1, 2}, {0, 2, 3}};
  const FaultNetwork faults(std::vector<FaultSurface>{FaultSurface::fromMesh("wall", wall)});
  relaxAlongFaults(cut, VertexCorners(cut.mesh), all(cut.mesh), faults);
  EXPECT_TRUE(cut.mesh.vertices[1].isApprox(Vector3(0.5, 0.25, 0.0)));
  EXPECT_TRUE(cut.mesh.vertices[2].isApprox(Vector3(2.5, 0.25, 0.0)));
  EXPECT_EQ(cut.mesh.vertices[0], Vector3(0, 0, 0)) << "its other neighbour on the border is on no fault";
  EXPECT_EQ(cut.mesh.vertices[4], Vector3(4, 0, 0)) << "on two faults";
  EXPECT_EQ(cut.mesh.vertices[6].z(), 1.0) << "on none";
}

} // namespace
} // namespace graben
