#include "graben/analysis/cutoff_distance.h"

#include "graben/core/errors.h"
#include "unit/mesh/meshes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace graben {
namespace {

TEST(CutoffDistance, OfALineBesideTheBorderIsItsOffset) {
  const CutoffDistances d =
      cutoffDistances(test::gridMesh(10), {{{10.5, 2, 0}, {10.5, 4, 0}, {10.5, 8, 0}}});
  EXPECT_EQ(d.all.count, 10000U);
  EXPECT_NEAR(d.all.rms, 0.5, 1e-12);
  EXPECT_NEAR(d.all.max, 0.5, 1e-12);
}

TEST(CutoffDistance, GoesToTheBorderNotToTheSurface) {
  const CutoffDistances d = cutoffDistances(test::gridMesh(10), {{{5, 5, 0}, {5, 5.001, 0}}});
  EXPECT_NEAR(d.all.rms, 5.0, 0.01);
  EXPECT_NEAR(cutoffDistances(test::gridMesh(10), {{{-3, 5, 4}, {-3, 5.001, 4}}}).all.rms, 5.0,
              1e-6);
}

TEST(CutoffDistance, SamplesSitInTheMiddleOfTheirSteps) {
  const CutoffDistances d =
      cutoffDistances(test::gridMesh(10), {{{10, 5, 0}, {20, 5, 0}}}, {10, 0});
  EXPECT_NEAR(d.all.mean, 5.0, 1e-12);
  EXPECT_NEAR(d.all.p50, 4.5, 1e-12);
  EXPECT_NEAR(d.all.max, 9.5, 1e-12);
}

TEST(CutoffDistance, IsWeightedByLengthHoweverManyPointsALineHas) {
  // 9 units at distance 1 in one segment, 1 unit at distance 2 in a hundred
  std::vector<Points> lines = {{{11, 0, 0}, {11, 9, 0}}, {}, {{0, 12, 0}}};
  for (int i = 0; i <= 100; ++i)
    lines[1].emplace_back(12, 4 + 0.01 * i, 0);
  const CutoffDistances d = cutoffDistances(test::gridMesh(10), lines, {1000, 0});
  EXPECT_NEAR(d.all.mean_square, 0.9 * 1.0 + 0.1 * 4.0, 1e-9);
  ASSERT_EQ(d.lines.size(), 3U);
  EXPECT_EQ(d.lines[0].count, 900U);
  EXPECT_NEAR(d.lines[0].rms, 1.0, 1e-12);
  EXPECT_EQ(d.lines[1].count, 100U);
  EXPECT_NEAR(d.lines[1].rms, 2.0, 1e-12);
  EXPECT_EQ(d.lines[2].count, 0U);
}

TEST(CutoffDistance, RefusesWhatCannotBeMeasured) {
  const TriangleMesh mesh = test::gridMesh(2);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(cutoffDistances(mesh, {}), InvalidInputError);
  EXPECT_THROW(cutoffDistances(mesh, {{{1, 1, 1}, {1, 1, 1}}}), InvalidInputError);
  EXPECT_THROW(cutoffDistances(mesh, {{{1, 1, 1}, {nan, 1, 1}, {2, 1, 1}}}), InvalidInputError);
  EXPECT_THROW(cutoffDistances(mesh, {{{1, 1, 1}, {2, 1, 1}}}, {0, 0}), InvalidInputError);
  TriangleMesh closed;
  closed.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  closed.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  EXPECT_THROW(cutoffDistances(closed, {{{1, 1, 1}, {2, 1, 1}}}), InvalidInputError);
}

TEST(CutoffDistance, IsTheSameForEveryNumberOfThreads) {
  const std::vector<Points> lines = {{{11, 0, 0}, {15, 9, 3}, {2, 2, 2}}};
  const CutoffDistances one = cutoffDistances(test::gridMesh(10), lines, {5000, 1});
  const CutoffDistances four = cutoffDistances(test::gridMesh(10), lines, {5000, 4});
  EXPECT_EQ(one.all.mean_square, four.all.mean_square);
  EXPECT_EQ(one.all.p95, four.all.p95);
}

} // namespace
} // namespace graben
