#include "shapes.h"

#include "graben/surface/viewpoints.h"

#include <gtest/gtest.h>

namespace graben {
namespace {

TEST(Viewpoints, OnAFaultTheyLieInsideTheMeshElsewhereWhereTheVerticesAre) {
  CutMesh cut;
  cut.mesh.vertices = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {4, 4, 2}, {9, 9, 9}};
  cut.mesh.triangles = {{0, 1, 2}, {1, 3, 2}};
  cut.vertex_faults = {{0, -1}, {-1, -1}, {0, 1}, {-1, -1}, {2, -1}};
  const Viewpoints viewpoints(cut, VertexCorners(cut.mesh, 1));
  const Vector3 first = Vector3(4, 4, 0) / 3.0, second = Vector3(8, 8, 2) / 3.0; // centroids
  EXPECT_LT((viewpoints.of(0) - 0.5 * first).norm(), 1e-12);
  EXPECT_LT((viewpoints.of(2) - 0.5 * (Vector3(0, 4, 0) + 0.5 * (first + second))).norm(), 1e-12);
  EXPECT_EQ(viewpoints.of(4), cut.mesh.vertices[4]) << "a vertex without triangles";
  EXPECT_EQ(viewpoints.of(1), cut.mesh.vertices[1]);
  cut.mesh.vertices[3] = {5, 5, 5};
  EXPECT_EQ(viewpoints.of(3), Vector3(5, 5, 5)) << "a vertex off the faults takes its viewpoint along";
}

} // namespace
} // namespace graben
