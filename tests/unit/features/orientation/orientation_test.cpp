#include "clouds.h"
#include "graben/core/errors.h"
#include "graben/features/orientation.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>

namespace graben {
namespace {

/// Turns about half of the normals round.
void scramble(Points& normals) {
  test::Random random(5);
  for (Vector3& normal : normals)
    if (random.uniform(0.0, 1.0) < 0.5)
      normal = -normal;
}

const OrientationOptions WITH_COMPONENTS = [] {
  OrientationOptions options;
  options.components = true;
  return options;
}();

Points scrambledNormals(const NeighborGrid& grid, const FaultNetwork& faults = {}, double step = 0.0) {
  TangentPlaneOptions options;
  options.rho_plus_delta = step;
  Points normals = estimateTangentPlanes(grid, faults, options).normals;
  scramble(normals);
  return normals;
}

TEST(Orientation, SphereOutward) {
  const Vector3 centre(461600.0, 5926880.0, -2000.0);
  const Points points = test::sphere(4000, 100.0, centre);
  const NeighborGrid grid(points);
  Points normals = scrambledNormals(grid);
  const OrientationResult result = orientNormals(grid, {}, WITH_COMPONENTS, normals);
  EXPECT_EQ(result.components, 1U);
  for (std::size_t i = 0; i < points.size(); ++i)
    ASSERT_GT(normals[i].dot((points[i] - centre).normalized()), 0.99);
}

TEST(Orientation, HalfSphereUp) {
  Points points = test::sphere(4000, 100.0, Vector3::Zero());
  points.erase(
      std::remove_if(points.begin(), points.end(), [](const Vector3& p) { return p.z() > 0.0; }),
      points.end());
  const NeighborGrid grid(points);
  Points normals = scrambledNormals(grid);
  orientNormals(grid, {}, WITH_COMPONENTS, normals);
  for (std::size_t i = 0; i < points.size(); ++i)
    ASSERT_LT(normals[i].dot(points[i].normalized()), -0.99) << "a bowl's normals are up, into it";
}

TEST(Orientation, TwoSheetsEachUp) {
  Points points = test::wavySheet(4000, 1000.0, 0.5);
  for (std::size_t i = 0; i < points.size(); ++i)
    points[i].z() += i % 2 == 0 ? 0.0 : 500.0;
  const NeighborGrid grid(points);
  Points normals = scrambledNormals(grid);
  const OrientationResult result = orientNormals(grid, {}, WITH_COMPONENTS, normals);
  EXPECT_EQ(result.components, 2U);
  for (std::size_t i = 0; i < points.size(); ++i) {
    ASSERT_GT(normals[i].z(), 0.5);
    ASSERT_EQ(result.of_pick[i], result.of_pick[i % 2]);
  }
  EXPECT_NE(result.of_pick[0], result.of_pick[1]);
}

TEST(Orientation, WavyHorizonAtUtmDepth) {
  Points points = test::wavySheet(20000, 10000.0, 2.0);
  for (Vector3& p : points)
    p += Vector3(461600.0, 5926880.0, -2500.0);
  const NeighborGrid grid(points);
  Points normals = scrambledNormals(grid);
  orientNormals(grid, {}, {}, normals);
  for (const Vector3& normal : normals)
    ASSERT_GT(normal.z(), 0.0);
}

TEST(Orientation, AFaultSeparatesComponents) {
  const test::ThrownFold fold(5.0);
  const NeighborGrid grid(fold.points);
  Points normals = scrambledNormals(grid, fold.faults);
  const OrientationResult result = orientNormals(grid, fold.faults, WITH_COMPONENTS, normals);
  EXPECT_EQ(result.components, 2U);
  for (std::size_t i = 0; i < fold.points.size(); ++i) {
    ASSERT_EQ(result.of_pick[i], result.of_pick[i < fold.left_count ? 0 : fold.left_count]);
    ASSERT_GT(normals[i].dot(fold.normalAt(i)), 0.999);
  }
  normals = scrambledNormals(grid, fold.faults);
  EXPECT_EQ(orientNormals(grid, {}, WITH_COMPONENTS, normals).components, 1U);
}

TEST(Orientation, LongestEdgeSeparatesComponents) {
  const test::ThrownFold fold(30.0);
  const NeighborGrid grid(fold.points);
  OrientationOptions options = WITH_COMPONENTS;
  options.rho_plus_delta = 12.0;
  Points normals = scrambledNormals(grid, {}, 12.0);
  EXPECT_EQ(orientNormals(grid, {}, options, normals).components, 2U);
}

TEST(Orientation, UpAxisTurnsEachNormal) {
  const Points points(4, Vector3::Zero());
  Points normals = {{0, 0, -1},
                    {0, 0.6, 0.8},
                    {1, 0, 0},
                    Vector3::Constant(std::numeric_limits<double>::quiet_NaN())};
  OrientationOptions options;
  options.method = OrientationMethod::UpAxis;
  const OrientationResult result = orientNormals(NeighborGrid(points), {}, options, normals);
  EXPECT_EQ(result.components, 1U);
  EXPECT_EQ(normals[0], Vector3(0, 0, 1));
  EXPECT_EQ(normals[1], Vector3(0, 0.6, 0.8));
  EXPECT_EQ(normals[2], Vector3(1, 0, 0));
  EXPECT_TRUE(normals[3].hasNaN());
  options.up = Vector3(-2, 0, 0);
  orientNormals(NeighborGrid(points), {}, options, normals);
  EXPECT_EQ(normals[2], Vector3(-1, 0, 0));
}

/// Orients along the tree, and as it is done where nobody asks for components.
void expectSameWithoutComponents(const Points& points, const Points& scrambled, const OrientationOptions& options, const FaultNetwork& faults = {}) {
  const NeighborGrid grid(points);
  Points tree = scrambled, quick = scrambled;
  OrientationOptions with = options;
  with.components = true;
  orientNormals(grid, faults, with, tree);
  const OrientationResult result = orientNormals(grid, faults, options, quick);
  EXPECT_EQ(result.components, 0U);
  EXPECT_TRUE(result.of_pick.empty());
  for (std::size_t i = 0; i < points.size(); ++i)
    ASSERT_TRUE(tree[i] == quick[i] || (tree[i].hasNaN() && quick[i].hasNaN())) << i;
}

TEST(Orientation, WithoutComponentsTheSameAsTheTree) {
  OrientationOptions options;
  options.rho_plus_delta = 40.0;
  for (const double steepness : {0.0, 0.5, 2.0, 8.0}) { // from flat to slopes whose normals are almost level
    Points points = test::wavySheet(4000, 1000.0, 1.0);
    for (Vector3& p : points)
      p.z() += steepness * 60.0 * std::sin(p.x() / 60.0);
    points[9].setConstant(std::numeric_limits<double>::quiet_NaN());
    expectSameWithoutComponents(points, scrambledNormals(NeighborGrid(points), {}, 40.0), options);
    options.up = Vector3(0.3, 0.0, -2.0);
  }
  options = {};
  const test::ThrownFold fold(5.0);
  expectSameWithoutComponents(fold.points, scrambledNormals(NeighborGrid(fold.points), fold.faults), options, fold.faults);
  expectSameWithoutComponents(test::sphere(3000, 100.0, Vector3::Zero()), scrambledNormals(NeighborGrid(test::sphere(3000, 100.0, Vector3::Zero()))), options);
}

/// In the grid's order, as the pipeline has them.
Points inOrder(const Points& points) {
  Points ordered;
  for (const Index i : spaceOrder(points))
    ordered.push_back(points[static_cast<std::size_t>(i)]);
  return ordered;
}

/// A flat box with rounded edges: smooth but for them, and so thin that picks of both faces lie within the longest edge of the graph.
Points flatBox(std::size_t count) {
  Points points = test::sphere(count, 1.0, Vector3::Zero());
  for (Vector3& p : points) {
    const double across = std::hypot(p.x(), p.y());
    p = Vector3(400.0 * p.x(), 400.0 * p.y(), across > 0.9 ? 15.0 * p.z() / 0.436 : std::copysign(15.0, p.z()));
  }
  return points;
}

TEST(Orientation, GroupsOfPicksAreTurnedAsTheirEdgesSay) {
  OrientationOptions options;
  options.rho_plus_delta = 45.0;
  const Points large = test::sphere(30000, 500.0, Vector3(40.0, 7.0, 0.0)), small = test::sphere(200, 30.0, Vector3::Zero());
  for (const Points& points : {inOrder(large), inOrder(small), inOrder(flatBox(30000))}) {
    ASSERT_TRUE(NeighborGrid(points).inOrder());
    expectSameWithoutComponents(points, scrambledNormals(NeighborGrid(points), {}, options.rho_plus_delta), options);
  }
}

TEST(Orientation, TheTreeDecidesWhereANeighbourPointsToTheOtherSide) {
  // A floor with a small roll in it, where normals lean over by 53, 106 and 53 degrees: turned up, that in the middle is against its neighbours.
  Points points, normals;
  for (int j = 0; j < 200; ++j)
    for (int i = 0; i < 200; ++i) {
      points.emplace_back(i, j, 0.0);
      const double lean = j > 50 && j < 150 && std::abs(i - 100) < 2 ? (i == 100 ? 106.0 : 53.0) : 0.0;
      normals.emplace_back(-std::sin(lean * 3.14159265358979323846 / 180.0), 0.0, std::cos(lean * 3.14159265358979323846 / 180.0));
    }
  const Points truth = normals;
  scramble(normals);
  OrientationOptions options;
  options.rho_plus_delta = 1.5;
  expectSameWithoutComponents(points, normals, options);
  const NeighborGrid grid(points);
  orientNormals(grid, {}, options, normals);
  for (std::size_t i = 0; i < points.size(); ++i)
    ASSERT_GT(normals[i].dot(truth[i]), 0.0);
}

TEST(Orientation, SingleWildNormalsTakeTheSideOfThoseAroundThem) {
  // Every other normal leans one way by 20 degrees; one in 211 lies almost level, so that turned up it would be against the others.
  Points points, normals;
  for (int j = 0; j < 100; ++j)
    for (int i = 0; i < 100; ++i) {
      points.emplace_back(i, j, 0.0);
      const bool wild = (100 * j + i) % 211 == 105;
      const double lean = (wild ? 95.0 : 20.0) * 3.14159265358979323846 / 180.0;
      normals.emplace_back(-std::sin(lean), 0.0, std::cos(lean));
    }
  const Points truth = normals;
  scramble(normals);
  OrientationOptions options;
  options.rho_plus_delta = 2.5;
  expectSameWithoutComponents(points, normals, options);
  orientNormals(NeighborGrid(points), {}, options, normals);
  for (std::size_t i = 0; i < points.size(); ++i)
    ASSERT_EQ(normals[i], truth[i]) << i;
}

/// Kruskal's algorithm on the whole graph: the normals on the sides that the tree says, seen from the tree's first pick.
Points orientedByKruskal(const NeighborGrid& grid, Points normals, std::size_t neighbors) {
  struct Edge {
    float weight;
    Index from, to;
  };
  std::vector<Edge> edges;
  std::vector<Neighbor> found;
  const auto at = [](Index i) { return static_cast<std::size_t>(i); };
  for (const Index from : grid.order()) {
    grid.nearest(grid.points()[at(from)], neighbors + 1, found);
    for (const Neighbor& to : found)
      if (to.index != from)
        edges.push_back({static_cast<float>(1.0 - std::abs(normals[at(from)].dot(normals[at(to.index)]))), from, to.index});
  }
  std::stable_sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) { return a.weight < b.weight; });
  std::vector<std::vector<Index>> trees(normals.size()); // members, by representative
  std::vector<Index> tree_of(normals.size());
  for (std::size_t i = 0; i < normals.size(); ++i)
    trees[i] = {tree_of[i] = static_cast<Index>(i)};
  for (const Edge& edge : edges) {
    Index a = tree_of[at(edge.from)], b = tree_of[at(edge.to)];
    if (a == b)
      continue;
    const bool against = normals[at(edge.from)].dot(normals[at(edge.to)]) < 0.0;
    if (trees[at(a)].size() < trees[at(b)].size())
      std::swap(a, b);
    for (const Index i : trees[at(b)]) {
      tree_of[at(i)] = a;
      if (against)
        normals[at(i)] = -normals[at(i)];
      trees[at(a)].push_back(i);
    }
  }
  return normals;
}

TEST(Orientation, WildNormalsAlongTheTree) {
  const Points points = test::wavySheet(20000, 1000.0, 1.0);
  const NeighborGrid grid(points);
  Points normals;
  test::Random random(11);
  for (std::size_t i = 0; i < points.size(); ++i) // wild ones on one side, nearly parallel ones on the other
    normals.push_back(Vector3(random.normal(1.0), random.normal(1.0), points[i].x() > 400.0 ? random.normal(1.0) : 20.0).normalized());
  const Points expected = orientedByKruskal(grid, normals, OrientationOptions().neighbors);
  for (const bool components : {false, true}) {
    Points oriented = normals;
    OrientationOptions options;
    options.components = components;
    EXPECT_EQ(orientNormals(grid, {}, options, oriented).components, components ? 1U : 0U);
    const bool turned = oriented[0] != expected[0];
    for (std::size_t i = 0; i < points.size(); ++i)
      ASSERT_EQ(oriented[i], turned ? Vector3(-expected[i]) : expected[i]) << i;
  }
}

TEST(Orientation, PicksWithoutNormalStayOut) {
  const Points points = test::wavySheet(1000, 1000.0, 1.0);
  const NeighborGrid grid(points);
  Points normals = scrambledNormals(grid);
  normals[7].setConstant(std::numeric_limits<double>::quiet_NaN());
  const OrientationResult result = orientNormals(grid, {}, WITH_COMPONENTS, normals);
  EXPECT_TRUE(normals[7].hasNaN());
  EXPECT_EQ(result.of_pick[7], -1);
  EXPECT_EQ(result.of_pick[8], 0);
}

TEST(Orientation, TheTreeGoesAroundASharpRidge) {
  // A roof that steepens from flat to a ridge where normals turn by more than 90 degrees: straight
  // across it signs come out wrong.
  Points points, normals;
  for (int j = 0; j < 60; ++j)
    for (int i = 0; i < 40; ++i) {
      const double x = i - 19.5, steepness = j / 30.0;
      points.emplace_back(x, j, -steepness * std::abs(x));
      normals.push_back(
          Vector3(x < 0.0 ? -steepness : steepness, std::abs(x) / 30.0, 1.0).normalized());
    }
  const Points truth = normals;
  scramble(normals);
  const NeighborGrid grid(points);
  EXPECT_EQ(orientNormals(grid, {}, WITH_COMPONENTS, normals).components, 1U);
  for (std::size_t i = 0; i < points.size(); ++i)
    ASSERT_GT(normals[i].dot(truth[i]), 0.0);
}

TEST(Orientation, TheSameForAnyNumberOfThreads) {
  const Points points = test::wavySheet(20000, 1000.0, 3.0);
  const NeighborGrid grid(points);
  Points one = scrambledNormals(grid), four = one;
  OrientationOptions options = WITH_COMPONENTS;
  options.threads = 1;
  const OrientationResult result_one = orientNormals(grid, {}, options, one);
  options.threads = 4;
  const OrientationResult result_four = orientNormals(grid, {}, options, four);
  EXPECT_EQ(one, four);
  EXPECT_EQ(result_one.of_pick, result_four.of_pick);
}

TEST(Orientation, EmptyAndWrongInput) {
  Points none;
  EXPECT_EQ(orientNormals(NeighborGrid(), {}, {}, none).components, 0U);
  const Points points = {{0, 0, 0}, {1, 0, 0}};
  EXPECT_THROW(orientNormals(NeighborGrid(points), {}, {}, none), InvalidInputError);
  Points normals(2, Vector3::UnitZ());
  OrientationOptions options;
  options.up.setZero();
  EXPECT_THROW(orientNormals(NeighborGrid(points), {}, options, normals), InvalidInputError);
}

} // namespace
} // namespace graben
