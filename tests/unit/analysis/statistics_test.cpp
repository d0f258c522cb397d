#include "graben/analysis/statistics.h"

#include <gtest/gtest.h>

namespace graben {
namespace {

TEST(Statistics, OfNothingAreZero) {
  const DistanceStatistics s = distanceStatistics({});
  EXPECT_EQ(s.count, 0U);
  EXPECT_EQ(s.rms, 0.0);
  EXPECT_EQ(s.max, 0.0);
}

TEST(Statistics, OfAFewNumbers) {
  const DistanceStatistics s = distanceStatistics({3.0, 1.0, 2.0, 6.0});
  EXPECT_EQ(s.count, 4U);
  EXPECT_DOUBLE_EQ(s.mean, 3.0);
  EXPECT_DOUBLE_EQ(s.mean_square, 12.5);
  EXPECT_DOUBLE_EQ(s.rms * s.rms, 12.5);
  EXPECT_EQ(s.p50, 2.0);
  EXPECT_EQ(s.p95, 6.0);
  EXPECT_EQ(s.max, 6.0);
}

TEST(Statistics, QuantilesAreValuesOfTheList) {
  std::vector<double> values;
  for (int i = 100; i > 0; --i)
    values.push_back(i);
  EXPECT_EQ(quantile(values, 0.0), 1.0);
  EXPECT_EQ(quantile(values, 0.01), 1.0);
  EXPECT_EQ(quantile(values, 0.5), 50.0);
  EXPECT_EQ(quantile(values, 0.951), 96.0);
  EXPECT_EQ(quantile(values, 1.0), 100.0);
}

} // namespace
} // namespace graben
