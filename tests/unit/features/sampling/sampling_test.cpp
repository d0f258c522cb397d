#include "clouds.h"
#include "graben/core/errors.h"
#include "graben/features/sampling.h"

#include <gtest/gtest.h>

#include <limits>

namespace graben {
namespace {

Sampling samplingOf(const Points& points, unsigned threads = 0) {
  return estimateSampling(NeighborGrid(points, 0.0, threads), threads);
}

Points gridWithHoles(double spacing) {
  Points points;
  for (int i = 0; i < 100; ++i)
    for (int j = 0; j < 100; ++j)
      if (std::hypot(i - 40, j - 40) > 8.0 && std::abs(i - 75) > 2)
        points.emplace_back(spacing * i, spacing * j, 0.2 * spacing * std::sin(0.1 * i));
  return points;
}

/// The largest distance from places on a wavy sheet, away from its border, to the nearest pick.
double largestGap(const Points& points, double size) {
  const NeighborGrid grid(points);
  test::Random random(11);
  double gap = 0.0;
  for (int i = 0; i < 20000; ++i) {
    const double x = random.uniform(0.05 * size, 0.95 * size),
                 y = random.uniform(0.05 * size, 0.95 * size);
    const Vector3 place(x, y, 0.01 * size * std::sin(6.0 * x / size) * std::cos(5.0 * y / size));
    gap = std::max(gap, std::sqrt(grid.nearestOne(place).squared_distance));
  }
  return gap;
}

TEST(Sampling, RegularGridStaysConnectedAndKeepsItsHoles) {
  const Sampling sampling = samplingOf(gridWithHoles(25.0));
  EXPECT_NEAR(sampling.spacing, 25.0, 0.3);
  EXPECT_GT(sampling.rho, 1.05 * 25.0) << "neighbourhoods must step from row to row";
  EXPECT_LT(sampling.rho + sampling.delta, 1.5 * 25.0)
      << "holes three spacings wide must stay open";
  EXPECT_LT(sampling.sigma, 0.1);
}

TEST(Sampling, RowsFartherApartThanTheirPicksAreSteppedBetween) {
  Points points;
  for (int i = 0; i < 120; ++i)
    for (int j = 0; j < 40; ++j)
      points.emplace_back(12.5 * i, 37.5 * j, 0.0);
  const Sampling sampling = samplingOf(points);
  EXPECT_NEAR(sampling.spacing, 12.5, 1e-6);
  EXPECT_GT(sampling.rho, 37.5);
  EXPECT_LT(sampling.rho, 1.5 * 37.5);
}

TEST(Sampling, RandomCloudIsRhoDense) {
  for (const std::size_t count : {std::size_t(2000), std::size_t(40000)}) {
    const double size = 48.0 * std::sqrt(static_cast<double>(count));
    const Points points = test::wavySheet(count, size, 2.0);
    const Sampling sampling = samplingOf(points);
    const double gap = largestGap(points, size);
    EXPECT_GT(sampling.rho, gap) << "the boundary test would tear holes";
    EXPECT_LT(sampling.rho, 1.6 * gap);
    EXPECT_NEAR(sampling.spacing, 24.0, 2.0);
    EXPECT_NEAR(sampling.sigma, 2.0, 0.15);
    EXPECT_GT(sampling.delta, 3.0 * 1.8);
    EXPECT_LT(sampling.delta, 12.0);
  }
}

TEST(Sampling, NoiseHigherThanTheSpacingIsMeasured) {
  const Sampling sampling = samplingOf(test::wavySheet(20000, 1000.0, 15.0));
  EXPECT_NEAR(sampling.sigma, 15.0, 1.5);
}

TEST(Sampling, FaultsDoNotCountAsNoise) {
  Points points = test::wavySheet(20000, 1000.0, 0.5);
  for (Vector3& p : points)
    p.z() += 60.0 * std::floor(p.x() / 200.0);
  const Sampling sampling = samplingOf(points);
  EXPECT_NEAR(sampling.sigma, 0.5, 0.1);
  EXPECT_LT(sampling.delta, 3.0);
}

TEST(Sampling, RepeatedPicksChangeNothing) {
  Points points = gridWithHoles(25.0);
  const Sampling once = samplingOf(points);
  const Points copy = points;
  for (int i = 0; i < 7; ++i)
    points.insert(points.end(), copy.begin(), copy.end());
  const Sampling repeated = samplingOf(points);
  EXPECT_NEAR(repeated.spacing, once.spacing, 1e-6 * once.spacing);
  EXPECT_NEAR(repeated.rho, once.rho, 0.1 * once.rho);
}

TEST(Sampling, TheSameFarFromTheOrigin) {
  Points points = test::wavySheet(5000, 1000.0, 1.0);
  const Sampling near = samplingOf(points);
  for (Vector3& p : points)
    p += Vector3(461596.0, 5926880.0, -2500.0);
  const Sampling far = samplingOf(points);
  EXPECT_NEAR(far.rho, near.rho, 0.02 * near.rho);
  EXPECT_NEAR(far.sigma, near.sigma, 0.02 * near.sigma);
}

TEST(Sampling, TheSameForAnyNumberOfThreads) {
  const Points points = test::wavySheet(30000, 1000.0, 1.0);
  const Sampling one = samplingOf(points, 1), four = samplingOf(points, 4);
  EXPECT_EQ(one.spacing, four.spacing);
  EXPECT_EQ(one.rho, four.rho);
  EXPECT_EQ(one.delta, four.delta);
  EXPECT_EQ(one.sigma, four.sigma);
}

TEST(Sampling, ThreePointsAreEnough) {
  const Sampling sampling = samplingOf({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  EXPECT_DOUBLE_EQ(sampling.spacing, 1.0);
  EXPECT_GT(sampling.rho, 1.0);
  EXPECT_TRUE(std::isfinite(sampling.delta) && std::isfinite(sampling.sigma));
}

TEST(Sampling, WhatIsNoSurfaceIsRefused) {
  const Vector3 nothing = Vector3::Constant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_THROW(samplingOf({}), InvalidInputError);
  EXPECT_THROW(samplingOf({nothing, nothing, nothing, nothing}), InvalidInputError);
  EXPECT_THROW(samplingOf({{0, 0, 0}, {1, 0, 0}}), InvalidInputError);
  EXPECT_THROW(samplingOf(Points(1000, Vector3(1, 2, 3))), InvalidInputError);
  Points line;
  for (int i = 0; i < 100; ++i)
    line.emplace_back(461596.0 + 3.0 * i, 5926880.0 + 4.0 * i, -5.0 * i);
  EXPECT_THROW(samplingOf(line), InvalidInputError);
}

} // namespace
} // namespace graben
