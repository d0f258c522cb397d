#include "graben/mesh/triangle_bvh.h"

#include "unit/mesh/meshes.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>

namespace graben {
namespace {

const Vector3 kA(0.0, 0.0, 0.0);
const Vector3 kB(4.0, 0.0, 0.0);
const Vector3 kC(0.0, 4.0, 0.0);

void expectNearest(const Vector3& p, const Vector3& point, const Vector3& barycentric) {
  const TrianglePoint found = nearestPointOnTriangle(p, kA, kB, kC);
  EXPECT_LT((found.point - point).norm(), 1e-12) << p.transpose();
  EXPECT_LT((found.barycentric - barycentric).norm(), 1e-12) << p.transpose();
  EXPECT_EQ((found.barycentric.array() == 0.0).count(), (barycentric.array() == 0.0).count())
      << p.transpose();
}

TEST(NearestPoint, InsideOnEdgesAndOnCorners) {
  expectNearest({1, 1, 5}, {1, 1, 0}, {0.5, 0.25, 0.25});
  expectNearest({1, -2, 1}, {1, 0, 0}, {0.75, 0.25, 0});
  expectNearest({-3, 3, 1}, {0, 3, 0}, {0.25, 0, 0.75});
  expectNearest({4, 4, -2}, {2, 2, 0}, {0, 0.5, 0.5});
  expectNearest({-1, -1, 0}, kA, {1, 0, 0});
  expectNearest({9, -1, 3}, kB, {0, 1, 0});
  expectNearest({-1, 9, 3}, kC, {0, 0, 1});
}

TEST(NearestPoint, OfDegenerateTriangles) {
  const auto distance = [](const Vector3& p, const Vector3& a, const Vector3& b, const Vector3& c) {
    const TrianglePoint found = nearestPointOnTriangle(p, a, b, c);
    EXPECT_NEAR(found.barycentric.sum(), 1.0, 1e-15);
    EXPECT_LT((found.barycentric[0] * a + found.barycentric[1] * b + found.barycentric[2] * c -
               found.point)
                  .norm(),
              1e-12);
    return (found.point - p).norm();
  };
  EXPECT_DOUBLE_EQ(distance({3, 4, 0}, kA, kA, kA), 5.0);
  EXPECT_DOUBLE_EQ(distance({2, 3, 0}, kA, kB, kB), 3.0);
  EXPECT_DOUBLE_EQ(distance({6, 2, 0}, kA, kB, {8, 0, 0}),
                   2.0); // on one line, the middle corner second
  EXPECT_DOUBLE_EQ(distance({6, 2, 0}, kA, {8, 0, 0}, {8, 0, 1e-300}), 2.0);
}

TEST(NearestPoint, NoPointOfTheTriangleIsNearer) {
  std::mt19937_64 generator(1);
  for (int i = 0; i < 2000; ++i) {
    const Vector3 a = test::randomPoint(generator, -1, 1);
    const Vector3 b = test::randomPoint(generator, -1, 1);
    const Vector3 c = i % 3 == 0
                          ? Vector3(a + (b - a) * 0.3 + 1e-7 * test::randomPoint(generator, -1, 1))
                          : test::randomPoint(generator, -1, 1);
    const Vector3 p = test::randomPoint(generator, -2, 2);
    const TrianglePoint found = nearestPointOnTriangle(p, a, b, c);
    EXPECT_GE(found.barycentric.minCoeff(), 0.0);
    const double d = (found.point - p).norm();
    for (int k = 0; k < 20; ++k) {
      double u = test::uniform(generator, 0, 1);
      double v = test::uniform(generator, 0, 1);
      if (u + v > 1.0) {
        u = 1.0 - u;
        v = 1.0 - v;
      }
      ASSERT_LE(d, (a + u * (b - a) + v * (c - a) - p).norm() + 1e-9);
    }
  }
}

TEST(NearestPoint, BothTrianglesOfAnEdgeFindTheSameBits) {
  std::mt19937_64 generator(2);
  for (int i = 0; i < 1000; ++i) {
    const Vector3 a = test::randomPoint(generator, -1, 1);
    const Vector3 b = test::randomPoint(generator, -1, 1);
    const Vector3 p = test::randomPoint(generator, -1, 1);
    const Vector3 away = 2.0 * a - p; // third corners behind the edge as seen from p
    const TrianglePoint one = nearestPointOnTriangle(p, a, b, away);
    const TrianglePoint two = nearestPointOnTriangle(p, b, a, away);
    ASSERT_TRUE(one.barycentric[2] != 0.0 || two.barycentric[2] != 0.0 || one.point == two.point);
  }
}

} // namespace
} // namespace graben
