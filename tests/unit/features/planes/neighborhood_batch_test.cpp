#include "planes/neighborhood_batch.h"

#include "clouds.h"
#include "planes/neighborhood_grower.h"
#include "planes/plane_fit.h"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace graben::detail {
namespace {

/// The numbers of the nearest points by sorting all; ties by number, points at the very place left out.
std::vector<std::size_t> nearestBySorting(const Points& points, const Vector3& place, std::size_t wanted) {
  std::vector<std::size_t> numbers;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points[i] != place)
      numbers.push_back(i);
  std::stable_sort(numbers.begin(), numbers.end(),
                   [&](std::size_t a, std::size_t b) { return (points[a] - place).squaredNorm() < (points[b] - place).squaredNorm(); });
  numbers.resize(std::min(wanted, numbers.size()));
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

void expectNearestAsBySorting(const Points& points, double squared_radius = 1e9) {
  NearbyPoints nearby;
  for (const Vector3& p : points)
    nearby.add(p.data(), 1);
  for (std::size_t i = 0; i < points.size(); i += 3)
    for (const std::size_t wanted : {1U, 2U, 14U, 59U}) {
      ASSERT_TRUE(nearby.findNearest(points[i].data(), wanted, squared_radius));
      std::vector<std::size_t> found(nearby.foundCount());
      for (std::size_t n = 0; n < found.size(); ++n)
        found[n] = nearby.found(n);
      ASSERT_EQ(found, nearestBySorting(points, points[i], wanted)) << "point " << i << ", wanted " << wanted;
    }
}

Points lattice(int side) {
  Points points;
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j)
      points.emplace_back(i, j, 0.0);
  return points;
}

TEST(NearbyPoints, NearestAsBySorting) {
  expectNearestAsBySorting(test::wavySheet(131, 100.0, 1.0));
  expectNearestAsBySorting(lattice(11)); // nearly all distances are tied
  expectNearestAsBySorting(test::wavySheet(131, 100.0, 1.0), 8100.0); // with a few more than wanted around a corner
  expectNearestAsBySorting(test::wavySheet(400, 100.0, 1.0)); // too many to be ranked
}

TEST(NearbyPoints, NearestAtAnyScaleAndPlace) {
  const Points sheet = test::wavySheet(131, 100.0, 1.0);
  for (const double scale : {1e-160, 1e-40, 1e-3, 1e16, 1e30}) {
    Points points = sheet;
    for (Vector3& p : points)
      p *= scale;
    expectNearestAsBySorting(points, 1e9 * scale * scale);
    expectNearestAsBySorting(points, std::numeric_limits<double>::infinity());
  }
  Points points = sheet;
  for (Vector3& p : points)
    p += Vector3(461596.15, 5926880.02, -1693.095);
  points.insert(points.begin(), Vector3(1e9, 0.0, 0.0)); // rough places about this one say nothing
  expectNearestAsBySorting(points, 1e30);
}

TEST(NearbyPoints, NothingIsFoundWhereTooFewAreWithinTheRadius) {
  const Points points = lattice(5);
  NearbyPoints nearby;
  const Vector3 corner = points[0];
  EXPECT_FALSE(nearby.findNearest(corner.data(), 1, 1e9));
  for (const Vector3& p : points)
    nearby.add(p.data(), 1);
  EXPECT_TRUE(nearby.findNearest(corner.data(), 3, 2.0)); // two at 1, one at the square root of 2
  EXPECT_EQ(nearby.foundCount(), 3U);
  EXPECT_FALSE(nearby.findNearest(corner.data(), 4, 2.0));
  EXPECT_FALSE(nearby.findNearest(corner.data(), 25, 1e9)); // the point itself does not count
  EXPECT_EQ(nearby.foundCount(), 0U);
}

TEST(NearbyPoints, MomentsAreSumsOverTheVectors) {
  const Points points = test::wavySheet(47, 100.0, 5.0);
  NearbyPoints nearby;
  for (const Vector3& p : points)
    nearby.add(p.data(), 1);
  for (std::size_t wanted = 1; wanted < points.size(); ++wanted) {
    ASSERT_TRUE(nearby.findNearest(points[5].data(), wanted, 1e9));
    const Moments m = nearby.foundMoments();
    Vector3 first = Vector3::Zero();
    Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
    double farthest = 0.0;
    for (const std::size_t n : nearestBySorting(points, points[5], wanted)) {
      const Vector3 d = points[n] - points[5];
      first += d;
      second += d * d.transpose();
      farthest = std::max(farthest, d.squaredNorm());
    }
    ASSERT_LT((first - Vector3(m.x, m.y, m.z)).norm(), 1e-10);
    Eigen::Matrix3d sums;
    sums << m.xx, m.yx, m.zx, m.yx, m.yy, m.zy, m.zx, m.zy, m.zz;
    ASSERT_LT((second - sums).norm(), 1e-9);
    ASSERT_EQ(m.farthest, farthest);
  }
}

TEST(LeastEigenvectors, AsByAnIterativeSolver) {
  test::Random random(11);
  std::vector<SymmetricMatrix> matrices;
  std::vector<Eigen::Matrix3d> full;
  for (int i = 0; i < 203; ++i) {
    Eigen::Matrix3d points;
    for (int c = 0; c < 9; ++c)
      points.data()[c] = random.normal(1.0);
    points.row(2) *= std::pow(10.0, -(i % 8));
    const Eigen::Quaterniond turned(random.normal(1.0), random.normal(1.0), random.normal(1.0), random.normal(1.0));
    const Eigen::Matrix3d turn = turned.normalized().toRotationMatrix();
    full.emplace_back(turn * (points * points.transpose()) * turn.transpose());
    const Eigen::Matrix3d& m = full.back();
    matrices.push_back({m(0, 0), m(1, 0), m(1, 1), m(2, 0), m(2, 1), m(2, 2)});
  }
  std::vector<LeastEigenvector> vectors(matrices.size());
  leastEigenvectors(matrices.data(), matrices.size(), vectors.data());
  int clear = 0;
  for (std::size_t i = 0; i < matrices.size(); ++i) {
    if (!vectors[i].clear)
      continue;
    ++clear;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(full[i]);
    const Vector3 values = solver.eigenvalues(), vector(vectors[i].x, vectors[i].y, vectors[i].z);
    const double gap = (values[1] - values[0]) / values[2];
    ASSERT_LT(test::lineAngle(vector, solver.eigenvectors().col(0)), 1e-11 / gap);
    ASSERT_NEAR(vector.norm(), 1.0, 1e-15);
    ASSERT_NEAR(vectors[i].share, std::max(0.0, values[0]) / values.sum(), 1e-12);
    LeastEigenvector alone;
    leastEigenvectors(&matrices[i], 1, &alone);
    ASSERT_EQ(alone.x, vectors[i].x); // whatever stands beside it
  }
  EXPECT_GT(clear, 150);
  SymmetricMatrix line;
  line.xx = 1.0;
  leastEigenvectors(&line, 1, vectors.data());
  EXPECT_FALSE(vectors[0].clear);
}

/// Each simple pick's sums are to the bit those of the neighbourhood grown by the rule. Returns the share of simple picks.
double shareOfSimple(const Points& points, const TangentPlaneOptions& options, const FaultNetwork& faults = {}) {
  const NeighborGrid grid(points);
  const MeasuredNormals measured(grid, options.measured);
  NeighborhoodBatch batch(grid, faults, measured, options);
  NeighborhoodGrower grower(grid, faults, options);
  std::vector<Index> neighbors;
  double simple = 0.0;
  for (std::size_t first = 0, count = 0; first < grid.size(); first += count) {
    const Index* picks = grid.order().data() + first;
    count = batch.extent(picks, grid.size() - first);
    EXPECT_GT(count, 0U);
    batch.find(picks, count);
    for (std::size_t i = 0; i < count; ++i) {
      if (!batch.isSimple(i))
        continue;
      simple += 1.0;
      grower.grow(picks[i], neighbors);
      const Vector3& pick = points[static_cast<std::size_t>(picks[i])];
      const Scatter expected = scatterOf(points, neighbors), scatter = scatterOf(pick, batch.moments(i), options.neighbors);
      EXPECT_TRUE(neighbors.size() == options.neighbors && scatter.centre == expected.centre && scatter.matrix() == expected.matrix() &&
                  scatter.farthest == expected.farthest)
          << "pick " << picks[i];
    }
  }
  return simple / static_cast<double>(points.size());
}

TEST(NeighborhoodBatch, AsGrownByTheRule) {
  const Points sheet = test::wavySheet(4000, 1000.0, 3.0);
  for (const std::size_t neighbors : {3U, 15U, 60U}) {
    TangentPlaneOptions options;
    options.neighbors = neighbors;
    EXPECT_GT(shareOfSimple(sheet, options), 0.98);
    options.max_distance = 80.0;
    EXPECT_GT(shareOfSimple(sheet, options), 0.8); // of 60, those at the border are farther
  }
}

TEST(NeighborhoodBatch, NeighboursBeyondAStepJoinInTheirTurn) {
  TangentPlaneOptions options;
  options.neighbors = 60;
  options.rho_plus_delta = 60.0; // the 60 nearest reach to about 70
  EXPECT_GT(shareOfSimple(test::wavySheet(4000, 1000.0, 3.0), options), 0.9);
  options.rho_plus_delta = 25.0;
  shareOfSimple(test::wavySheet(4000, 1000.0, 3.0), options);
}

TEST(NeighborhoodBatch, TiesAndRepeatedPicks) {
  Points points = lattice(40);
  TangentPlaneOptions options;
  EXPECT_GT(shareOfSimple(points, options), 0.98);
  const Points once = points;
  for (std::size_t i = 0; i < once.size(); i += 3)
    points.insert(points.end(), 1 + i % 4, once[i]);
  for (Vector3& p : points)
    p.z() = p.x() == 7.0 && p.y() < 20.0 ? -0.0 : p.z(); // the same place
  EXPECT_GT(shareOfSimple(points, options), 0.98);
}

TEST(NeighborhoodBatch, NothingIsSimpleAcrossAFaultOrBesideAMeasuredNormal) {
  test::ThrownFold fold(0.0);
  test::Random random(5);
  for (Vector3& p : fold.points)
    p += Vector3(random.normal(1.0), random.normal(1.0), random.normal(1.0));
  fold.points.emplace_back(0.0, 100.0, 10.0); // on the fault
  TangentPlaneOptions options;
  const double share = shareOfSimple(fold.points, options, fold.faults);
  EXPECT_GT(share, 0.8);
  EXPECT_LT(share, 0.98);
  options.measured = {{100, Vector3::UnitZ()}};
  EXPECT_LT(shareOfSimple(fold.points, options, fold.faults), share);
}

TEST(NeighborhoodBatch, PlacesOfVeryDifferentDensity) {
  Points points = test::wavySheet(1500, 1000.0, 1.0);
  const Points dense = test::wavySheet(3000, 1.0, 0.001, 2);
  points.insert(points.end(), dense.begin(), dense.end());
  points.emplace_back(1e6, 1e6, 1e6);
  EXPECT_GT(shareOfSimple(points, {}), 0.9);
}

} // namespace
} // namespace graben::detail
