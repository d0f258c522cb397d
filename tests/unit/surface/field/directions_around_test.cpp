#include "field/directions_around.h"

#include "shapes.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace graben {
namespace {

double widestGap(std::vector<double> angles) {
  std::sort(angles.begin(), angles.end());
  double gap = angles.front() + 2.0 * test::kPi - angles.back();
  for (std::size_t i = 1; i < angles.size(); ++i)
    gap = std::max(gap, angles[i] - angles[i - 1]);
  return gap;
}

TEST(DirectionsAround, GapsAreThoseOfTheSortedAngles) {
  test::Random random(5);
  const Vector3 normal = Vector3(0.3, -0.2, 0.9).normalized();
  for (int round = 0; round < 3000; ++round) {
    const auto count = static_cast<std::size_t>(random.uniform(1.0, 12.0));
    const double from = random.uniform(-7.0, 7.0);
    const double width = random.uniform(0.0, 6.5);
    DirectionsAround directions(normal);
    std::vector<double> angles;
    for (std::size_t i = 0; i < count; ++i) {
      angles.push_back(std::remainder(from + random.uniform(0.0, width), 2.0 * test::kPi));
      directions.add(random.uniform(0.1, 9.0) * directions.at(angles.back()) + random.uniform(-3.0, 3.0) * normal);
    }
    ASSERT_EQ(directions.size(), count);
    const double gap = widestGap(angles);
    for (const double limit : {1.7, 2.6, test::kPi, 5.0})
      ASSERT_EQ(directions.gapsBelow(limit), gap < limit) << gap << ' ' << limit;
  }
}

TEST(DirectionsAround, AxesAndNothingAtAll) {
  DirectionsAround directions(Vector3::UnitZ());
  EXPECT_TRUE(directions.empty());
  EXPECT_FALSE(directions.gapsBelow(7.0));
  directions.add(Vector3::Zero());
  EXPECT_FALSE(directions.gapsBelow(6.0));
  for (const double angle : {0.5, 1.0, 1.5})
    directions.add(directions.at(angle * test::kPi));
  EXPECT_TRUE(directions.gapsBelow(1.6));
  EXPECT_FALSE(directions.gapsBelow(1.5));
}

} // namespace
} // namespace graben
