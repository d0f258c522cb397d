#include "clouds.h"
#include "graben/features/neighbor_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <limits>

namespace graben {
namespace {

constexpr double NAN_VALUE = std::numeric_limits<double>::quiet_NaN();

std::vector<Neighbor> bruteForce(const Points& points, const Vector3& query, std::size_t k,
                                 double max_distance) {
  std::vector<Neighbor> all;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double squared = (points[i] - query).squaredNorm();
    if (squared <= max_distance * max_distance)
      all.push_back({static_cast<Index>(i), squared});
  }
  std::sort(all.begin(), all.end(), [](const Neighbor& a, const Neighbor& b) {
    return std::make_pair(a.squared_distance, a.index) <
           std::make_pair(b.squared_distance, b.index);
  });
  all.resize(std::min(all.size(), k));
  return all;
}

void expectSame(const std::vector<Neighbor>& found, const std::vector<Neighbor>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    ASSERT_EQ(found[i].index, expected[i].index) << "neighbour " << i;
    ASSERT_EQ(found[i].squared_distance, expected[i].squared_distance) << "neighbour " << i;
  }
}

/// What a query without an order finds, sorted.
std::vector<Neighbor> collected(const NeighborGrid& grid, const Vector3& query, double radius) {
  PointsAround around;
  grid.collectWithin(query, radius, around);
  std::vector<Neighbor> found;
  for (std::size_t i = 0; i < around.count; ++i) {
    EXPECT_EQ(Vector3(around.dx[i], around.dy[i], around.dz[i]), grid.points()[static_cast<std::size_t>(around.index[i])] - query);
    found.push_back({around.index[i], around.squared_distance[i]});
  }
  std::sort(found.begin(), found.end(), [](const Neighbor& a, const Neighbor& b) {
    return std::make_pair(a.squared_distance, a.index) < std::make_pair(b.squared_distance, b.index);
  });
  return found;
}

/// Runs around a box hold every point near it once.
void checkRunsAroundBox(const NeighborGrid& grid, const Vector3& corner, double length) {
  Bounds box;
  box.extend(corner);
  box.extend(corner + Vector3(length, 2.0 * length, 0.5 * length));
  std::vector<PointRun> runs;
  grid.runsAround(box, length, runs);
  std::vector<int> times(grid.points().size(), 0);
  for (const PointRun& run : runs)
    for (std::size_t i = 0; i < run.count; ++i)
      ++times[static_cast<std::size_t>(run.index(i))];
  for (std::size_t i = 0; i < times.size(); ++i) {
    const Vector3& p = grid.points()[i];
    const bool near = p.allFinite() && (box.low - p).cwiseMax(p - box.high).cwiseMax(0.0).norm() <= length;
    ASSERT_TRUE(times[i] == 1 || (times[i] == 0 && !near)) << "point " << i;
  }
}

/// All kinds of queries about some points of the cloud and some off it, against a search through
/// all points.
void checkAgainstBruteForce(const NeighborGrid& grid, double length) {
  constexpr std::size_t ALL = std::numeric_limits<std::size_t>::max();
  constexpr double ANYWHERE = std::numeric_limits<double>::infinity();
  const Points& points = grid.points();
  ASSERT_GT(grid.cellSize(), 0.0);
  test::Random random(7);
  std::vector<Neighbor> found;
  for (int q = 0; q < 60; ++q) {
    Vector3 query = points[static_cast<std::size_t>(grid.order()[static_cast<std::size_t>(random.uniform(0.0, static_cast<double>(grid.size())))])];
    if (q % 3 == 1)
      query += Vector3(random.normal(length), random.normal(length), random.normal(length));
    if (q % 3 == 2)
      query += 100.0 * Vector3(random.normal(length), random.normal(length), random.normal(length));
    for (const std::size_t k : {std::size_t(1), std::size_t(15), std::size_t(200)})
      for (const double max_distance : {ANYWHERE, 1.5 * length, 0.0}) {
        grid.nearest(query, k, found, max_distance);
        ASSERT_NO_FATAL_FAILURE(expectSame(found, bruteForce(points, query, k, max_distance)));
      }
    grid.within(query, 2.0 * length, found);
    ASSERT_NO_FATAL_FAILURE(expectSame(found, bruteForce(points, query, ALL, 2.0 * length)));
    ASSERT_NO_FATAL_FAILURE(expectSame(collected(grid, query, 2.0 * length), found));
    for (const double wide : {1.0, 6.0, 40.0})
      ASSERT_NO_FATAL_FAILURE(checkRunsAroundBox(grid, query, wide * length));
    for (const double max_distance : {ANYWHERE, length}) {
      const Neighbor one = grid.nearestOne(query, max_distance);
      const std::vector<Neighbor> expected = bruteForce(points, query, 1, max_distance);
      ASSERT_EQ(one.index, expected.empty() ? -1 : expected.front().index);
      if (!expected.empty()) {
        ASSERT_EQ(one.squared_distance, expected.front().squared_distance);
      }
    }
  }
}

void checkAgainstBruteForce(const Points& points, double length) {
  checkAgainstBruteForce(NeighborGrid(points), length);
}

TEST(NeighborGrid, SheetAgainstBruteForce) {
  checkAgainstBruteForce(test::wavySheet(4000, 1000.0, 1.0), 15.0);
}

TEST(NeighborGrid, SheetAtUtmCoordinates) {
  Points points = test::wavySheet(2000, 1000.0, 1.0);
  for (Vector3& p : points)
    p += Vector3(461596.15, 5926880.02, -1693.095);
  checkAgainstBruteForce(points, 20.0);
}

TEST(NeighborGrid, RegularGridWithItsTies) {
  Points points;
  for (int i = 0; i < 60; ++i)
    for (int j = 0; j < 60; ++j)
      points.emplace_back(50.0 * i, 50.0 * j, 0.0);
  checkAgainstBruteForce(points, 50.0);
}

TEST(NeighborGrid, VolumeAndLine) {
  test::Random random(3);
  Points volume, line;
  for (int i = 0; i < 3000; ++i) {
    volume.emplace_back(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0),
                        random.uniform(-1.0, 1.0));
    line.emplace_back(random.uniform(0.0, 1e4), 3.0, -2.0);
  }
  checkAgainstBruteForce(volume, 0.1);
  checkAgainstBruteForce(line, 4.0);
}

TEST(NeighborGrid, ClustersOfVeryDifferentDensity) {
  test::Random random(4);
  Points points = test::wavySheet(1500, 1000.0, 1.0);
  for (int i = 0; i < 6000; ++i)
    points.emplace_back(500.0 + random.normal(0.01), 500.0 + random.normal(0.01),
                        random.normal(0.01));
  checkAgainstBruteForce(points, 0.01);
  checkAgainstBruteForce(points, 30.0);
}

TEST(NeighborGrid, Duplicates) {
  Points points = test::wavySheet(300, 1000.0, 1.0);
  for (int copy = 0; copy < 3; ++copy)
    points.insert(points.end(), points.begin(), points.begin() + 300);
  points.insert(points.end(), 500, points[17]);
  checkAgainstBruteForce(points, 50.0);
}

TEST(NeighborGrid, RunsTellWherePointsRepeat) {
  Points points = test::wavySheet(3000, 1000.0, 1.0);
  std::vector<PointRun> runs;
  const auto pointsThatMayRepeat = [&](const NeighborGrid& grid) {
    grid.runsAround(Bounds{{200.0, 200.0, -100.0}, {800.0, 800.0, 100.0}}, 10.0, runs);
    std::size_t count = 0;
    for (const PointRun& run : runs)
      count += run.may_repeat ? run.count : 0;
    return count;
  };
  EXPECT_EQ(pointsThatMayRepeat(NeighborGrid(points)), 0U);
  for (std::size_t i = 0; i < 20; ++i) {
    const Vector3 repeated = points[100 * i];
    points.push_back(repeated);
  }
  const NeighborGrid grid(points);
  EXPECT_LT(pointsThatMayRepeat(grid), points.size() / 2);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto isThere = [&](const Vector3& p) { return p == points[i]; };
    if (std::count_if(points.begin(), points.end(), isThere) == 1)
      continue;
    grid.runsAround(points[i], 0.0, runs);
    for (const PointRun& run : runs)
      EXPECT_TRUE(run.may_repeat || std::none_of(run.points, run.points + run.count, isThere)) << "point " << i;
  }
}

TEST(NeighborGrid, ManyIdenticalPointsCostNoMoreThanOthers) {
  const Points points(500000, Vector3(1.0, 2.0, 3.0));
  const NeighborGrid grid(points);
  std::vector<Neighbor> found;
  const auto start = std::chrono::steady_clock::now();
  for (int q = 0; q < 20000; ++q) {
    grid.nearest(Vector3(1.0, 2.0, 3.0 + q), 15, found);
    ASSERT_EQ(found.size(), 15U);
    ASSERT_EQ(found.back().index, 14);
    ASSERT_EQ(grid.nearestOne(Vector3(1.0, 2.0, 3.0 + q)).index, 0);
  }
  // Hundredths of a second where ties are cut off; most of a minute where each query reads every
  // point.
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5));
}

TEST(NeighborGrid, OutliersAndFarQueries) {
  Points points = test::wavySheet(3000, 1000.0, 1.0);
  points.emplace_back(1e6, 0.0, 0.0);
  checkAgainstBruteForce(points, 20.0);
  points.emplace_back(0.0, -1e13, 3e12);
  points.emplace_back(0.0, 2e13, 0.0);
  checkAgainstBruteForce(points, 20.0);
  const NeighborGrid grid(points);
  EXPECT_EQ(grid.nearestOne(Vector3(3e6, 0.0, 0.0)).index, 3000);
  EXPECT_LT(grid.cellSize(), 100.0);
}

TEST(NeighborGrid, CellSizeGiven) {
  const Points points = test::wavySheet(2000, 1000.0, 1.0);
  for (const double cell_size : {1e-6, 1.0, 200.0, 1e6}) {
    const NeighborGrid grid(points, cell_size);
    EXPECT_EQ(grid.cellSize(), cell_size);
    std::vector<Neighbor> found;
    for (std::size_t i = 0; i < points.size(); i += 100) {
      grid.nearest(points[i], 15, found);
      expectSame(found, bruteForce(points, points[i], 15, 1e9));
    }
  }
}

TEST(NeighborGrid, NotFinitePointsAreLeftOut) {
  const Points points = {
      {0, 0, 0}, {NAN_VALUE, 0, 0}, {1, 0, 0}, {0, std::numeric_limits<double>::infinity(), 0}};
  const NeighborGrid grid(points);
  EXPECT_EQ(grid.size(), 2U);
  std::vector<Neighbor> found;
  grid.nearest(Vector3(0.9, 0, 0), 10, found);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].index, 2);
  EXPECT_EQ(found[1].index, 0);
  grid.nearest(Vector3(NAN_VALUE, 0, 0), 10, found);
  EXPECT_TRUE(found.empty());
  grid.within(Vector3(0, NAN_VALUE, 0), 10, found);
  EXPECT_TRUE(found.empty());
  EXPECT_EQ(grid.nearestOne(Vector3(0, NAN_VALUE, 0)).index, -1);
}

Points inSpaceOrder(const Points& points) {
  Points ordered;
  for (const Index i : spaceOrder(points))
    ordered.push_back(points[static_cast<std::size_t>(i)]);
  return ordered;
}

TEST(NeighborGrid, PointsInSpaceOrderStayInPlace) {
  const Points sheet = test::wavySheet(20000, 1000.0, 1.0);
  EXPECT_FALSE(NeighborGrid(sheet).inOrder());
  Points points = sheet;
  points[17].setConstant(NAN_VALUE);
  points = inSpaceOrder(points);
  EXPECT_TRUE(points.back().hasNaN());
  const NeighborGrid grid(points);
  EXPECT_TRUE(grid.inOrder());
  for (std::size_t i = 0; i < grid.size(); ++i)
    ASSERT_EQ(grid.order()[i], static_cast<Index>(i));

  EXPECT_EQ(grid.size(), points.size() - 1);
}

TEST(NeighborGrid, FromTheKeysOfSpaceOrder) {
  Points sheet = test::wavySheet(20000, 1000.0, 1.0);
  for (std::size_t i = 0; i < sheet.size(); i += 1000)
    sheet[i].setConstant(NAN_VALUE);
  GridKeys keys;
  Points points;
  for (const Index i : spaceOrder(sheet, 0, &keys))
    points.push_back(sheet[static_cast<std::size_t>(i)]);
  const NeighborGrid grid(points, keys), expected(points);
  EXPECT_TRUE(grid.inOrder());
  EXPECT_EQ(grid.cellSize(), expected.cellSize());
  EXPECT_EQ(grid.order(), expected.order());
  checkAgainstBruteForce(grid, 15.0);
  EXPECT_EQ(NeighborGrid(sheet, GridKeys()).order(), NeighborGrid(sheet).order());
  spaceOrder({}, 0, &keys);
  EXPECT_EQ(NeighborGrid(Points(), keys).size(), 0U);
}

TEST(NeighborGrid, PointsTakenOutAreFoundNoMore) {
  const Points sheet = test::wavySheet(8000, 1000.0, 1.0);
  for (Points points : {inSpaceOrder(sheet), sheet}) {
    const NeighborGrid grid(points);
    std::vector<Index> taken_out;
    for (std::size_t i = 0; i < points.size(); ++i)
      if (i % 7 == 0 || i < 100 || (points[i] - Vector3(500.0, 500.0, 0.0)).norm() < 150.0) {
        points[i].setConstant(NAN_VALUE);
        taken_out.push_back(static_cast<Index>(i));
      }
    const NeighborGrid fewer = grid.withoutThoseTakenOut();
    EXPECT_EQ(grid.withoutThoseTakenOut(taken_out).order(), fewer.order());
    EXPECT_EQ(fewer.withoutThoseTakenOut(taken_out).order(), fewer.order());
    EXPECT_EQ(fewer.inOrder(), grid.inOrder());
    EXPECT_EQ(fewer.cellSize(), grid.cellSize());
    EXPECT_EQ(fewer.size(), static_cast<std::size_t>(std::count_if(points.begin(), points.end(), [](const Vector3& p) { return p.allFinite(); })));
    checkAgainstBruteForce(fewer, 40.0);
  }
}

TEST(NeighborGrid, OrderDoesNotDependOnThePointsOrder) {
  Points points = test::wavySheet(40000, 1000.0, 1.0);
  const Points ordered = inSpaceOrder(points);
  const double cell_size = NeighborGrid(points).cellSize();
  std::reverse(points.begin(), points.end());
  EXPECT_EQ(NeighborGrid(points).cellSize(), cell_size);
  const Points again = inSpaceOrder(points);
  for (std::size_t i = 0; i < points.size(); ++i) // points of one place on the curve may change theirs
    ASSERT_LT((again[i] - ordered[i]).norm(), 0.1 * cell_size);
}

TEST(NeighborGrid, SpaceOrderOfHostileClouds) {
  EXPECT_TRUE(spaceOrder({}).empty());
  EXPECT_EQ(spaceOrder(Points(3, Vector3::Constant(NAN_VALUE))).size(), 3U);
  const Points same(100000, Vector3(1.0, 2.0, 3.0));
  EXPECT_EQ(spaceOrder(same).back(), 99999);
  EXPECT_TRUE(NeighborGrid(same).inOrder());
}

TEST(NeighborGrid, EmptyAndOnePoint) {
  const Points none, only_nan = {Vector3::Constant(NAN_VALUE)}, one = {{5, 6, 7}};
  std::vector<Neighbor> found;
  for (const NeighborGrid& grid : {NeighborGrid(), NeighborGrid(none), NeighborGrid(only_nan)}) {
    EXPECT_EQ(grid.size(), 0U);
    grid.nearest(Vector3::Zero(), 3, found);
    EXPECT_TRUE(found.empty());
    grid.within(Vector3::Zero(), 3.0, found);
    EXPECT_TRUE(found.empty());
    EXPECT_EQ(grid.nearestOne(Vector3::Zero()).index, -1);
  }
  const NeighborGrid grid(one);
  grid.nearest(Vector3(1e9, 0, 0), 3, found);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(grid.nearestOne(Vector3(5, 6, 7)).squared_distance, 0.0);
}

TEST(NeighborGrid, OrderIsAPermutationAndTheSameForAnyThreads) {
  const Points points = test::wavySheet(150000, 1000.0, 1.0);
  const NeighborGrid one(points, 0.0, 1), four(points, 0.0, 4);
  EXPECT_EQ(one.cellSize(), four.cellSize());
  ASSERT_EQ(one.order(), four.order());
  std::vector<Index> sorted = one.order();
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t i = 0; i < sorted.size(); ++i)
    ASSERT_EQ(sorted[i], static_cast<Index>(i));
}

} // namespace
} // namespace graben
