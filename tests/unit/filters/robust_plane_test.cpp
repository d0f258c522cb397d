#include "robust_plane.h"

#include <gtest/gtest.h>

namespace graben::detail {
namespace {

std::vector<WeightedPoint> tilted(double slope) {
  std::vector<WeightedPoint> points;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 5; ++j)
      points.push_back({Vector3(10.0 * i, 10.0 * j, slope * 10.0 * i), 1.0});
  return points;
}

TEST(RobustPlane, IsExactOnAPlane) {
  const PlaneAt plane = robustPlaneAt({80.0, 20.0, 0.3 * 80.0 + 5.0}, tilted(0.3), 0.1);
  ASSERT_TRUE(plane.valid);
  EXPECT_NEAR(std::abs(plane.offset), 5.0 / std::sqrt(1.09), 1e-9);
  EXPECT_NEAR(std::abs(plane.normal.dot(Vector3(-0.3, 0.0, 1.0).normalized())), 1.0, 1e-12);
}

TEST(RobustPlane, IgnoresAThirdOfOutliers) {
  for (const double off : {3.0, 40.0, 100.0}) {
    std::vector<WeightedPoint> points = tilted(0.3);
    for (std::size_t i = 0; i < points.size(); i += 3)
      points[i].position.z() += off;
    const PlaneAt plane = robustPlaneAt({80.0, 20.0, 24.0}, points, 0.1);
    ASSERT_TRUE(plane.valid);
    EXPECT_NEAR(plane.offset, 0.0, 1e-6) << off;
    EXPECT_NEAR(std::abs(plane.normal.z()), 1.0 / std::sqrt(1.09), 1e-6) << off;
  }
}

TEST(RobustPlane, KnowsHowUnsureItIs) {
  const double near = robustPlaneAt({25.0, 20.0, 0.0}, tilted(0.0), 0.1).leverage;
  const double far = robustPlaneAt({100.0, 20.0, 0.0}, tilted(0.0), 0.1).leverage;
  EXPECT_NEAR(near, 1.0 / 30.0, 1e-9);
  EXPECT_NEAR(far, 1.0 / 30.0 + 75.0 * 75.0 / (5.0 * 1750.0), 1e-9);
}

TEST(RobustPlane, NeedsThreePointsThatAreNotOnALine) {
  EXPECT_FALSE(robustPlaneAt({0.0, 0.0, 0.0}, {}, 1.0).valid);
  std::vector<WeightedPoint> line;
  for (int i = 0; i < 9; ++i)
    line.push_back({Vector3(i, 2.0 * i, -i), 1.0});
  EXPECT_FALSE(robustPlaneAt({0.0, 0.0, 0.0}, line, 1.0).valid);
}

} // namespace
} // namespace graben::detail
