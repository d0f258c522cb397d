#include "shapes.h"

#include "graben/surface/quadric.h"

#include <gtest/gtest.h>

namespace graben {
namespace {

TEST(Quadric, ErrorIsTheSumOfSquaredDistances) {
  test::Random random(1);
  Quadric a, b;
  double expected = 0.0;
  const Vector3 v(random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(-3, 3));
  for (int i = 0; i < 20; ++i) {
    const Vector3 n = Vector3(random.normal(1), random.normal(1), random.normal(1)).normalized();
    const Vector3 p(random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(-3, 3));
    const double weight = random.uniform(0.1, 2.0);
    (i < 10 ? a : b).addPlane(p, n, weight);
    expected += weight * std::pow(n.dot(v - p), 2);
  }
  a += b;
  EXPECT_NEAR(a.error(v), expected, 1e-9 * expected);
}

TEST(Quadric, ThreePlanesMeetInTheMinimizer) {
  Quadric q;
  const Vector3 corner(1.0, -2.0, 0.5);
  for (const Vector3& n : {Vector3(1, 0, 0.2), Vector3(0, 1, 0.1), Vector3(0.3, -0.2, 1)})
    q.addPlane(corner, n.normalized());
  EXPECT_LT((q.minimizer(1e-6) - corner).norm(), 1e-12);
  EXPECT_LT(q.error(corner), 1e-24);
}

TEST(Quadric, OnePlaneMovesOnlyAcrossItself) {
  Quadric q;
  EXPECT_TRUE(q.minimizer(0.05).isZero()) << "nothing known, nothing moved";
  const Vector3 n = Vector3(0.1, -0.3, 1.0).normalized(), p(4.0, 2.0, 7.0);
  for (int i = 0; i < 15; ++i)
    q.addPlane(p, n);
  EXPECT_LT((q.minimizer(0.05) - n.dot(p) * n).norm(), 1e-12);
}

/// Q of many points on a wedge about a crease along y through \a crease; its faces fall by \a angle
/// on both sides.
Quadric wedge(const Vector3& crease, double angle, int left, int right) {
  Quadric q;
  test::Random random(2);
  for (int i = 0; i < left + right; ++i) {
    const double side = i < left ? -1.0 : 1.0;
    const Vector3 n(side * std::sin(angle), 0.0, std::cos(angle));
    const double out = random.uniform(0.2, 3.0);
    q.addPlane(crease + Vector3(side * out * std::cos(angle), random.uniform(-4, 4),
                                -out * std::sin(angle)),
               n);
  }
  return q;
}

TEST(Quadric, AWedgeDrawsToItsCreaseAndNotAlongIt) {
  for (const double angle : {0.3, 0.8, 1.3})
    for (const auto& [left, right] : {std::pair{10, 10}, {17, 5}}) {
      const Vector3 crease(0.7, 0.0, -0.4);
      const Vector3 step = wedge(crease, angle, left, right).minimizer(0.01);
      EXPECT_NEAR(step.x(), crease.x(), 1e-9) << "however many picks are on either side";
      EXPECT_NEAR(step.z(), crease.z(), 1e-9);
      EXPECT_NEAR(step.y(), 0.0, 1e-9) << "nothing is known along the crease";
    }
}

TEST(Quadric, ANearlyFlatWedgeIsNotMovedSideways) {
  const Vector3 step = wedge({5.0, 0.0, 0.1}, 0.02, 10, 10).minimizer(0.05);
  EXPECT_NEAR(step.x(), 0.0, 1e-3) << "the sideways position is undetermined under the cut-off";
  EXPECT_LT(std::abs(step.z()), 0.3);
  EXPECT_NEAR(wedge({5.0, 0.0, 0.1}, 0.02, 10, 10).minimizer(0.0).x(), 5.0, 1e-6)
      << "without the cut-off it is followed far";
}

TEST(Quadric, TurnsAndScalesWithTheData) {
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.7, Vector3(1, 2, 3).normalized()).toRotationMatrix();
  for (const double scale : {1e-3, 1.0, 1e3}) {
    Quadric plain, moved;
    test::Random random(5);
    for (int i = 0; i < 15; ++i) {
      const Vector3 p(random.uniform(-3, 3), random.uniform(-3, 3), random.normal(0.1));
      const Vector3 n = Vector3(random.normal(0.3), random.normal(0.3), 1.0).normalized();
      plain.addPlane(p, n);
      moved.addPlane(scale * (turn * p), turn * n);
    }
    EXPECT_LT((moved.minimizer(0.01) / scale - turn * plain.minimizer(0.01)).norm(), 1e-9);
  }
}

} // namespace
} // namespace graben
