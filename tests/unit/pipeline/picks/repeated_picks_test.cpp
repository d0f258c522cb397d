#include "picks/repeated_picks.h"

#include <gtest/gtest.h>

#include <limits>

namespace graben {
namespace {

TEST(RepeatedPicks, EachPlaceStaysOnce) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Points points = {{1, 2, 3}, {0.0, 0, 0}, {1, 2, 3}, {nan, 0, 0}, {-0.0, 0, -0.0}, {3, 2, 1}, {nan, 0, 0}, {1, 2, 3}};
  EXPECT_EQ(dropRepeated(points), 3U);
  const std::vector<bool> kept = {true, true, false, false, false, true, false, false};
  for (std::size_t i = 0; i < points.size(); ++i)
    EXPECT_EQ(points[i].allFinite(), kept[i]) << i;
}

TEST(RepeatedPicks, ManyOfFewPlaces) {
  Points points;
  for (int i = 0; i < 30000; ++i)
    points.emplace_back(i % 300, 1e6 + i % 300, 0.1 * (i % 300));
  EXPECT_EQ(dropRepeated(points), 29700U);
  Points none;
  EXPECT_EQ(dropRepeated(none), 0U);
}

} // namespace
} // namespace graben
