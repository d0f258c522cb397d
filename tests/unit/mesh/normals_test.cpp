#include "graben/mesh/normals.h"

#include "unit/mesh/meshes.h"

#include <gtest/gtest.h>

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
