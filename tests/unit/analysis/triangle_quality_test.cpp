#include "graben/analysis/triangle_quality.h"

#include "unit/mesh/meshes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace graben {
namespace {

TEST(TriangleQuality, OfAnEquilateralTriangle) {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 5}, {2, 0, 5}, {1, std::sqrt(3.0), 5}};
  mesh.triangles = {{0, 1, 2}};
  const TriangleQuality q = triangleQuality(mesh);
  EXPECT_NEAR(q.smallest_angle_min, 60.0, 1e-9);
  EXPECT_NEAR(q.smallest_angle_median, 60.0, 1e-9);
  EXPECT_NEAR(q.aspect_ratio_p99, 1.0, 1e-12);
  EXPECT_NEAR(q.edge_length_median, 2.0, 1e-12);
  EXPECT_EQ(q.share_below_10_degrees, 0.0);
}

TEST(TriangleQuality, OfAGridOfRightTriangles) {
  const TriangleQuality q = triangleQuality(test::gridMesh(10, 3.0));
  EXPECT_EQ(q.triangles, 200U);
  EXPECT_NEAR(q.smallest_angle_p1, 45.0, 1e-9);
  EXPECT_NEAR(q.aspect_ratio_p99, std::sqrt(3.0), 1e-12);
  EXPECT_DOUBLE_EQ(q.edge_length_median, 3.0);
}

TEST(TriangleQuality, SliversShow) {
  TriangleMesh mesh = test::gridMesh(2);
  const auto v = static_cast<Index>(mesh.vertices.size());
  const double angle = 5.0 * std::acos(-1.0) / 180.0;
  mesh.vertices.emplace_back(10, 0, 0);
  mesh.vertices.emplace_back(11, 0, 0);
  mesh.vertices.emplace_back(10 + std::cos(angle), std::sin(angle), 0);
  mesh.triangles.push_back({v, v + 1, v + 2});
  mesh.triangles.push_back({v, v, v + 2});
  const TriangleQuality q = triangleQuality(mesh);
  EXPECT_DOUBLE_EQ(q.share_below_10_degrees, 0.2);
  EXPECT_EQ(q.smallest_angle_min, 0.0);
  EXPECT_TRUE(std::isinf(q.aspect_ratio_p99));
  mesh.triangles.pop_back();
  EXPECT_NEAR(triangleQuality(mesh).smallest_angle_min, 5.0, 1e-9);
}

TEST(TriangleQuality, OfNothingIsZeroAndThreadsDoNotMatter) {
  EXPECT_EQ(triangleQuality(TriangleMesh()).triangles, 0U);
  std::mt19937_64 generator(1);
  const TriangleMesh mesh = test::soup(generator, 20000, 10.0, 1.0);
  EXPECT_EQ(triangleQuality(mesh, 1).smallest_angle_p1, triangleQuality(mesh, 4).smallest_angle_p1);
}

} // namespace
} // namespace graben
