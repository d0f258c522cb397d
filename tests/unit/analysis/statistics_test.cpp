#include "graben/analysis/statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>

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

TEST(Statistics, OfManyNumbersAreTheSameForEveryNumberOfThreads) {
  std::vector<double> values;
  std::uint64_t state = 1;
  for (int i = 0; i < 300001; ++i) {
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    values.push_back(static_cast<double>(state >> 40) * 1e-3);
  }
  const DistanceStatistics one = distanceStatistics(values, 1);
  const DistanceStatistics four = distanceStatistics(values, 4);
  EXPECT_EQ(one.mean, four.mean);
  EXPECT_EQ(one.mean_square, four.mean_square);
  EXPECT_EQ(one.p50, quantile(values, 0.5));
  EXPECT_EQ(one.p95, quantile(values, 0.95));
  EXPECT_EQ(four.p95, one.p95);
  EXPECT_EQ(one.max, quantile(values, 1.0));
}

TEST(Statistics, OfManyEqualNumbersAreThatNumber) {
  const DistanceStatistics s = distanceStatistics(std::vector<double>(200000, 0.25));
  EXPECT_EQ(s.p50, 0.25);
  EXPECT_EQ(s.p95, 0.25);
  EXPECT_EQ(s.mean, 0.25);
}

} // namespace
} // namespace graben
