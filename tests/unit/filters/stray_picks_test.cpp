#include "graben/filters/stray_picks.h"

#include <gtest/gtest.h>

#include <limits>
#include <numeric>

namespace graben {
namespace {

FaultNetwork wallAt(double x) {
  TriangleMesh mesh;
  mesh.vertices = {{x, -500, -500}, {x, 1500, -500}, {x, 1500, 500}, {x, -500, 500}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return FaultNetwork({FaultSurface::fromMesh("wall", mesh)});
}

/// A grid for x < 500, and a few picks beyond.
Points gridAndStrays(std::size_t strays) {
  Points points;
  for (int i = 0; i < 50; ++i)
    for (int j = 0; j < 50; ++j)
      points.emplace_back(10.0 * i, 20.0 * j, 0.0);
  for (std::size_t i = 0; i < strays; ++i)
    points.emplace_back(504.0, 300.0 + 12.0 * static_cast<double>(i), 1.0);
  return points;
}

std::vector<Index> straysOf(const Points& points, const FaultNetwork& faults, std::size_t fewest = 20) {
  std::vector<Index> all(points.size());
  std::iota(all.begin(), all.end(), 0);
  StrayOptions options;
  options.step = 30.0;
  options.fewest = fewest;
  return strayPicks(NeighborGrid(points), faults, all, options);
}

TEST(StrayPicks, FewPicksAloneBeyondAFaultAreStrays) {
  std::vector<Index> expected(8);
  std::iota(expected.begin(), expected.end(), 2500);
  EXPECT_EQ(straysOf(gridAndStrays(8), wallAt(497.0)), expected);
}

TEST(StrayPicks, AreNoneWhereNoFaultPartsThemFromTheOthers) { EXPECT_TRUE(straysOf(gridAndStrays(8), wallAt(900.0)).empty()); }

TEST(StrayPicks, EnoughPicksAreAPieceOfTheirOwn) { EXPECT_TRUE(straysOf(gridAndStrays(25), wallAt(497.0)).empty()); }

TEST(StrayPicks, PicksThatAreNotFiniteAreNotLookedAt) {
  Points points = gridAndStrays(3);
  points[7].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(straysOf(points, wallAt(497.0)).size(), 3U);
}

} // namespace
} // namespace graben
