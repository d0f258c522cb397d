#include "graben/mesh/normals.h"

#include "unit/mesh/meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace graben {
namespace {

TEST(Normals, AreaNormalIsTwiceTheAreaAndZeroForADegenerateTriangle) {
  const TriangleMesh mesh = test::gridMesh(1, 3.0);
  EXPECT_EQ(areaNormal(mesh, mesh.triangles[0]), Vector3(0, 0, 9));
  EXPECT_EQ(areaNormal(mesh, {0, 1, 1}), Vector3(0, 0, 0));
}

TEST(Normals, WeighByAngleNotByNumberOfTriangles) {
  // The corner of a box: one face split in two triangles at the corner, the others whole.
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}};
  computeVertexNormals(mesh);
  EXPECT_LT((mesh.normals[0] - Vector3(1, 1, 1).normalized()).norm(), 1e-12);
}

TEST(Normals, OfSomeVerticesAreThoseOfAll) {
  std::mt19937_64 generator(3);
  TriangleMesh mesh = test::gridMesh(70); // large enough for several threads
  for (Vector3& p : mesh.vertices)
    p.z() = test::uniform(generator, -1.0, 1.0);
  const VertexCorners corners(mesh, 3);
  computeVertexNormals(mesh, corners);
  mesh.vertices[500].z() += 1.0;
  TriangleMesh all = mesh;
  computeVertexNormals(all);
  std::vector<Index> around;
  for (const Index corner : corners.of(500))
    for (const Index v : mesh.triangles[static_cast<std::size_t>(corner / 3)])
      around.push_back(v);
  std::sort(around.begin(), around.end());
  around.erase(std::unique(around.begin(), around.end()), around.end());
  EXPECT_EQ(around.size(), 7U);
  updateVertexNormals(mesh, corners, around);
  EXPECT_EQ(mesh.normals, all.normals);
}

TEST(VertexCorners, AreAllCornersInRisingOrder) {
  std::mt19937_64 generator(4);
  TriangleMesh mesh = test::gridMesh(100);
  std::shuffle(mesh.triangles.begin(), mesh.triangles.end(), generator);
  for (const unsigned threads : {1U, 3U}) {
    const VertexCorners corners(mesh, threads);
    std::size_t count = 0;
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
      EXPECT_TRUE(std::is_sorted(corners.of(v).begin(), corners.of(v).end()));
      for (const Index corner : corners.of(v)) {
        ASSERT_EQ(mesh.triangles[static_cast<std::size_t>(corner / 3)][static_cast<std::size_t>(corner % 3)], static_cast<Index>(v));
        ++count;
      }
    }
    EXPECT_EQ(count, 3 * mesh.triangles.size());
  }
}

TEST(Normals, AreUpWhereNoProperTriangleIs) {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {0, 1, 0}, {0, 2, 0}, {5, 5, 5}};
  mesh.triangles = {{0, 1, 2}};
  computeVertexNormals(mesh);
  for (const Vector3& n : mesh.normals)
    EXPECT_EQ(n, Vector3(0, 0, 1));
}

TEST(Normals, AreTheSameForEveryThreadCount) {
  TriangleMesh mesh = test::gridMesh(100);
  for (Vector3& v : mesh.vertices)
    v.z() = std::sin(v.x()) * std::cos(0.7 * v.y());
  computeVertexNormals(mesh, 1);
  const Points one = mesh.normals;
  computeVertexNormals(mesh, 4);
  EXPECT_EQ(one, mesh.normals);
}

} // namespace
} // namespace graben
