#include "graben/mesh/triangle_bvh.h"

#include "unit/mesh/meshes.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>

namespace graben {
namespace {

/// A grid in a tilted, shifted frame: its vertices are rounded, no coordinate is special.
struct TiltedGrid {
  Eigen::Matrix3d rotation;
  Vector3 shift;
  TriangleMesh mesh;

  explicit TiltedGrid(double offset)
      : shift(offset, -0.7 * offset, 0.3 * offset)
      , mesh(test::gridMesh(8, 12.5)) {
    rotation = Eigen::AngleAxisd(0.83, Vector3(1, 2, 3).normalized()).toRotationMatrix();
    for (Vector3& v : mesh.vertices) {
      v.z() = 3.0 * std::sin(0.1 * v.x()) +
              2.0 * std::cos(0.13 * v.y()); // folded, so that edges are real
      v = rotation * v + shift;
    }
  }
  Vector3 up() const { return rotation * Vector3::UnitZ(); }
};

class SegmentEdgeCases : public testing::TestWithParam<double> {};

TEST_P(SegmentEdgeCases, ThroughEdgesAndCornersAlwaysHitsAndComesOnce) {
  const TiltedGrid grid(GetParam());
  const TriangleBvh bvh(grid.mesh);
  std::mt19937_64 generator(4);
  for (const Triangle& triangle : grid.mesh.triangles)
    for (std::size_t e = 0; e < 3; ++e) {
      const Vector3& p = grid.mesh.vertices[static_cast<std::size_t>(triangle[e])];
      const Vector3& q = grid.mesh.vertices[static_cast<std::size_t>(triangle[(e + 1) % 3])];
      for (const double t : {0.0, 0.25, 1.0 / 3.0, 0.5, test::uniform(generator, 0, 1)}) {
        const Vector3 on_edge = p + t * (q - p);
        const Vector3 direction = 20.0 * grid.up() + test::randomPoint(generator, -4, 4);
        const double beyond = test::uniform(generator, 0.2, 3);
        const auto hits = bvh.allHits(on_edge - direction, on_edge + beyond * direction);
        ASSERT_EQ(hits.size(), 1U) << on_edge.transpose();
        ASSERT_NEAR(hits[0].parameter, 1.0 / (1.0 + beyond), 1e-9);
        ASSERT_EQ(bvh.countHits(on_edge - direction, on_edge + beyond * direction), 1U);
        ASSERT_TRUE(bvh.hits(on_edge + direction, on_edge - beyond * direction));
      }
    }
}

TEST_P(SegmentEdgeCases, ThatEndOnTheMeshHitIt) {
  const TiltedGrid grid(GetParam());
  const TriangleBvh bvh(grid.mesh);
  std::mt19937_64 generator(5);
  for (int i = 0; i < 3000; ++i) {
    const Triangle& triangle = grid.mesh.triangles[generator() % grid.mesh.triangles.size()];
    const double u = test::uniform(generator, 0, 1);
    const double v = test::uniform(generator, 0, 1 - u);
    const auto corner = [&](std::size_t e) {
      return grid.mesh.vertices[static_cast<std::size_t>(triangle[e])];
    };
    const Vector3 on_mesh = corner(0) + u * (corner(1) - corner(0)) + v * (corner(2) - corner(0));
    const Vector3 away = on_mesh + (i % 2 == 0 ? 15.0 : -15.0) * grid.up();
    ASSERT_TRUE(bvh.hits(away, on_mesh));
    ASSERT_TRUE(bvh.hits(on_mesh, away));
    ASSERT_FALSE(bvh.hits(away, on_mesh + 1e-6 * (away - on_mesh)));
  }
}

TEST_P(SegmentEdgeCases, ThroughALongThinFanNeverSlips) {
  // A flat square as a fan of needles from one corner region, shifted far from the origin.
  TriangleMesh mesh;
  const Vector3 shift(GetParam(), GetParam(), GetParam());
  mesh.vertices.push_back(shift);
  constexpr Index n = 4000;
  for (Index i = 0; i <= n; ++i)
    mesh.vertices.push_back(shift + Vector3(100.0, 100.0 * i / n, 100.0 * i / n));
  for (Index i = 1; i <= n; ++i)
    mesh.triangles.push_back({0, i, i + 1});
  const TriangleBvh bvh(mesh);
  std::mt19937_64 generator(6);
  for (int i = 0; i < 20000; ++i) {
    const double x = test::uniform(generator, 1, 99);
    const double y = x * test::uniform(generator, 0.01, 0.99);
    const Vector3 on_plane = shift + Vector3(x, y, y);
    ASSERT_TRUE(bvh.hits(on_plane - Vector3(3, 1, 50), on_plane + Vector3(3, 1, 50)));
  }
}

INSTANTIATE_TEST_SUITE_P(Offsets, SegmentEdgeCases, testing::Values(0.0, 1e4, 5e6),
                         [](const auto& tested) { return "AtOffset" + std::to_string(static_cast<long>(tested.param)); });

TEST(SegmentEdgeCases, TheLowestTriangleStandsForACornerOfAFlatGrid) {
  const TriangleBvh bvh(test::gridMesh(4));
  const auto corner = bvh.allHits({1, 1, 1}, {1, 1, -1});
  ASSERT_EQ(corner.size(), 1U);
  EXPECT_EQ(corner[0].triangle, 0);
  EXPECT_EQ(corner[0].point, Vector3(1, 1, 0));
  EXPECT_EQ(bvh.firstHit({1, 1, 1}, {1, 1, -1})->triangle, 0);
}

TEST(SegmentEdgeCases, TwoSheetsThatTouchNowhereComeTwice) {
  TriangleMesh mesh = test::gridMesh(2);
  TriangleMesh upper = mesh;
  for (Vector3& v : upper.vertices)
    v.z() = 1e-9;
  append(mesh, upper);
  const TriangleBvh bvh(mesh);
  EXPECT_EQ(bvh.allHits({1, 1, -1}, {1, 1, 1}).size(), 2U);
  EXPECT_EQ(bvh.allHits({0.5, 0.5, -1}, {0.5, 0.5, 1}).size(), 2U); // on a diagonal
  EXPECT_EQ(bvh.countHits({0.5, 0.5, -1}, {0.5, 0.5, 1}), 2U);
  EXPECT_EQ(bvh.countHits({0.6, 0.5, -1}, {0.6, 0.5, 1}), 2U);
}

TEST(SegmentEdgeCases, DoubledVerticesOfASeamCountAsShared) {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  EXPECT_EQ(TriangleBvh(mesh).allHits({0.5, 0.5, -1}, {0.5, 0.5, 1}).size(), 1U);
}

TEST(SegmentEdgeCases, InThePlaneOrBesideTheMeshIsNoHit) {
  const TriangleBvh bvh(test::gridMesh(4));
  EXPECT_FALSE(bvh.hits({-1, 2, 0}, {5, 2, 0}));
  EXPECT_FALSE(bvh.hits({0.2, 0.3, 0}, {3, 2, 0}));
  EXPECT_FALSE(bvh.hits({-1e-9, 2, -1}, {-1e-9, 2, 1}));
  EXPECT_FALSE(bvh.hits({1, 1, 0}, {1, 1, 0}));
  TriangleMesh corner = test::gridMesh(1);
  corner.triangles.pop_back();
  EXPECT_FALSE(TriangleBvh(corner).hits({0.2, 0.8, 0},
                                        {0.2, 0.8, 1})); // starts in the plane, in the box, outside
  EXPECT_FALSE(TriangleBvh(corner).hits({0.2, 0.8, 1}, {0.2, 0.8, 0}));
  EXPECT_TRUE(bvh.hits({0, 2, -1}, {0, 2, 1})); // on the border
}

} // namespace
} // namespace graben
