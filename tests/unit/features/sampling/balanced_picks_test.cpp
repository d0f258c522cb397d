#include "clouds.h"
#include "graben/features/balanced_picks.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace graben {
namespace {

/// Lines along x at y = 0, 400, 800, ..., a pick every 10, on z = 0.1 x, and 50 higher for x > 1003.
Points lines(double noise) {
  test::Random random(5);
  Points points;
  for (double y = 0.0; y <= 2400.0; y += 400.0)
    for (double x = 0.0; x <= 2000.0; x += 10.0)
      points.emplace_back(x, y, 0.1 * x + (x > 1003.0 ? 50.0 : 0.0) + random.normal(noise));
  return points;
}

FaultNetwork wallAt(double x) {
  TriangleMesh mesh;
  mesh.vertices = {{x, -500, -900}, {x, 3000, -900}, {x, 3000, 900}, {x, -500, 900}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return FaultNetwork({FaultSurface::fromMesh("wall", mesh)});
}

BalancedPicks balancedOf(const Points& points, const FaultNetwork& faults, unsigned threads = 0) {
  const NeighborGrid grid(points);
  return balancedPicks(grid, pickLayout(grid), faults, threads);
}

TEST(BalancedPicks, StandAQuarterOfTheLineDistanceApartAndHaveLessNoise) {
  const BalancedPicks balanced = balancedOf(lines(2.0), {});
  const double stretch = 7.0 * 2000.0 / static_cast<double>(balanced.points.size());
  EXPECT_GT(stretch, 400.0 / 8.0);
  EXPECT_LT(stretch, 400.0 / 2.5);
  double squares = 0.0;
  std::size_t counted = 0;
  for (std::size_t i = 0; i < balanced.points.size(); ++i) {
    const Vector3& p = balanced.points[i];
    if (std::abs(p.x() - 1003.0) < 100.0)
      continue;
    squares += std::pow(p.z() - 0.1 * p.x() - (p.x() > 1003.0 ? 50.0 : 0.0), 2);
    ++counted;
  }
  EXPECT_LT(std::sqrt(squares / static_cast<double>(counted)), 1.0);
}

TEST(BalancedPicks, CountEveryPickOnce) {
  Points points = lines(2.0);
  points[17].y() = std::numeric_limits<double>::quiet_NaN();
  const BalancedPicks balanced = balancedOf(points, {});
  std::vector<std::uint32_t> counted(balanced.points.size(), 0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    ASSERT_EQ(balanced.of[i] < 0, i == 17);
    if (balanced.of[i] >= 0)
      ++counted[static_cast<std::size_t>(balanced.of[i])];
  }
  EXPECT_EQ(counted, balanced.picks);
}

TEST(BalancedPicks, NoneReachesAcrossAFault) {
  const Points points = lines(0.0);
  const BalancedPicks balanced = balancedOf(points, wallAt(1003.0));
  for (std::size_t i = 0; i < points.size(); ++i)
    ASSERT_EQ(points[i].x() > 1003.0, balanced.points[static_cast<std::size_t>(balanced.of[i])].x() > 1003.0);
  for (const Vector3& p : balanced.points)
    EXPECT_NEAR(p.z(), 0.1 * p.x() + (p.x() > 1003.0 ? 50.0 : 0.0), 1e-9);
}

TEST(BalancedPicks, DensePicksStayAsTheyAre) {
  Points points = test::wavySheet(3000, 500.0, 1.0);
  const NeighborGrid grid(points);
  PickLayout layout;
  layout.line_distances.assign(points.size(), 0.0F);
  const BalancedPicks balanced = balancedPicks(grid, layout, {});
  ASSERT_EQ(balanced.points.size(), points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    EXPECT_EQ(balanced.points[static_cast<std::size_t>(balanced.of[i])], points[i]);
}

TEST(BalancedPicks, AreTheSameForEveryNumberOfThreads) {
  const Points points = lines(2.0);
  EXPECT_EQ(balancedOf(points, wallAt(1003.0), 1).points, balancedOf(points, wallAt(1003.0), 3).points);
}

} // namespace
} // namespace graben
