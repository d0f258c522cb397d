#include "clouds.h"
#include "graben/core/errors.h"
#include "graben/features/tangent_planes.h"

#include <Eigen/Eigenvalues>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace graben {
namespace {

TangentPlanes planesOf(const Points& points, const TangentPlaneOptions& options = {},
                       const FaultNetwork& faults = {}) {
  return estimateTangentPlanes(NeighborGrid(points), faults, options);
}

double worstAngle(const test::ThrownFold& fold, const TangentPlanes& planes) {
  double worst = 0.0;
  for (std::size_t i = 0; i < fold.points.size(); ++i) {
    const double angle = test::lineAngle(planes.normals[i], fold.normalAt(i));
    worst = std::isnan(angle) ? 90.0 : std::max(worst, angle);
  }
  return worst;
}

TEST(TangentPlanes, ExactOnAPlaneFarFromTheOrigin) {
  Points points;
  const test::PlanarGrid grid = {12.5, 0.0, 500.0, 500.0, 0.37, -0.21, -1500.0};
  grid.appendTo(points);
  for (Vector3& p : points)
    p += Vector3(461600.0, 5926880.0, -2000.0);
  const TangentPlanes planes = planesOf(points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    ASSERT_LT(test::lineAngle(planes.normals[i], grid.normal()), 1e-7);
    ASSERT_NEAR((planes.centres[i] - points[i]).dot(grid.normal()), 0.0, 1e-8);
    ASSERT_NEAR(planes.curvature[i], 0.0, 1e-12);
  }
}

TEST(TangentPlanes, ExactAtAFaultWherePlainNeighboursAreWrong) {
  const test::ThrownFold fold;
  EXPECT_LT(worstAngle(fold, planesOf(fold.points, {}, fold.faults)), 1e-6);
  EXPECT_GT(worstAngle(fold, planesOf(fold.points)), 20.0);
}

TEST(TangentPlanes, KeepManyNeighboursAtAFault) {
  const test::ThrownFold fold;
  const NeighborGrid grid(fold.points);
  std::vector<Index> neighbors;
  for (std::size_t i = 0; i < fold.points.size(); ++i) {
    growNeighborhood(grid, fold.faults, static_cast<Index>(i), {}, neighbors);
    ASSERT_EQ(neighbors.size(), 15U);
    ASSERT_EQ(neighbors.front(), static_cast<Index>(i));
    for (const Index n : neighbors)
      ASSERT_EQ(static_cast<std::size_t>(n) < fold.left_count, i < fold.left_count);
  }
}

TEST(TangentPlanes, ThePaperRuleStopsAtAGapWithoutAnyFault) {
  const test::ThrownFold fold(30.0);
  TangentPlaneOptions options;
  options.rho_plus_delta = 12.0; // rows are 10 apart, the gap with its throw more than 30
  EXPECT_LT(worstAngle(fold, planesOf(fold.points, options)), 1e-6);
}

TEST(TangentPlanes, NeighbourhoodReachesAroundAHoleStepByStep) {
  // A horseshoe of picks: the far arm is near in distance but many steps away.
  Points points = {{0, 0, 0}};
  for (int i = 1; i <= 6; ++i)
    points.emplace_back(i, 0, 0);
  points.emplace_back(6, 1, 0);
  for (int i = 6; i >= 0; --i)
    points.emplace_back(i, 2, 0);
  TangentPlaneOptions options;
  options.neighbors = 9;
  options.rho_plus_delta = 1.5;
  std::vector<Index> neighbors;
  const NeighborGrid grid(points);
  growNeighborhood(grid, {}, 0, options, neighbors);
  EXPECT_THAT(neighbors, testing::ElementsAre(0, 1, 2, 3, 4, 5, 6, 7, 9));
  options.neighbors = 10; // past the bend the arm leads back towards the pick
  growNeighborhood(grid, {}, 0, options, neighbors);
  EXPECT_EQ(neighbors.back(), 10);
  options.rho_plus_delta = 2.5; // now the far arm is a step away
  options.neighbors = 3;
  growNeighborhood(grid, {}, 0, options, neighbors);
  EXPECT_THAT(neighbors, testing::ElementsAre(0, 1, 2));
  options.neighbors = 4;
  growNeighborhood(grid, {}, 0, options, neighbors);
  EXPECT_THAT(neighbors, testing::ElementsAre(0, 1, 2, 14));
}

TEST(TangentPlanes, APickOnTheFaultTakesOneSide) {
  test::ThrownFold fold;
  fold.points.emplace_back(0.0, 200.0, 20.0);
  const TangentPlanes planes = planesOf(fold.points, {}, fold.faults);
  const Vector3& normal = planes.normals.back();
  ASSERT_TRUE(normal.allFinite());
  EXPECT_LT(std::min(test::lineAngle(normal, fold.left.normal()),
                     test::lineAngle(normal, fold.right.normal())),
            1e-6);
}

TEST(TangentPlanes, RepeatedPicksDoNotHideThePlane) {
  Points points;
  const test::PlanarGrid grid = {10.0, 0.0, 100.0, 100.0, 0.5, 0.0, 0.0};
  grid.appendTo(points);
  const Points once = points;
  for (int i = 0; i < 40; ++i)
    points.insert(points.end(), once.begin(), once.end());
  const TangentPlanes planes = planesOf(points);
  for (const Vector3& normal : planes.normals)
    ASSERT_LT(test::lineAngle(normal, grid.normal()), 1e-6);
}

TEST(TangentPlanes, NoPlaneWhereThereIsNone) {
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  Points line;
  for (int i = 0; i < 30; ++i)
    line.emplace_back(3.0 * i, 4.0 * i, 5.0 * i);
  for (const Points& points :
       {line, Points(50, Vector3(1, 2, 3)), Points{{1, 2, 3}}, Points{{0, 0, 0}, {1, 0, 0}},
        Points{{nothing, 0, 0}, {0, 0, 0}, {1, 0, 0}}}) {
    const TangentPlanes planes = planesOf(points);
    ASSERT_EQ(planes.normals.size(), points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
      EXPECT_TRUE(planes.normals[i].hasNaN() && planes.centres[i].hasNaN() &&
                  std::isnan(planes.curvature[i]));
  }
  EXPECT_TRUE(planesOf({}).normals.empty());
}

TEST(TangentPlanes, APickThatIsNotFiniteGetsNoneAndHarmsNoOther) {
  Points points;
  const test::PlanarGrid grid;
  grid.appendTo(points);
  points[100].y() = std::numeric_limits<double>::infinity();
  const TangentPlanes planes = planesOf(points);
  for (std::size_t i = 0; i < points.size(); ++i)
    EXPECT_EQ(planes.normals[i].allFinite(), i != 100);
}

TEST(TangentPlanes, AtPlacesAsAtPicks) {
  const Points points = test::wavySheet(3000, 1000.0, 1.0);
  const NeighborGrid grid(points);
  const TangentPlanes own = estimateTangentPlanes(grid, {}, {}),
                      at = estimateTangentPlanesAt(grid, {}, {}, points);
  EXPECT_EQ(own.normals, at.normals);
  EXPECT_EQ(own.centres, at.centres);
  const TangentPlanes off = estimateTangentPlanesAt(grid, {}, {}, {Vector3(500.0, 500.0, 3.0)});
  EXPECT_LT(test::lineAngle(off.normals[0], Vector3::UnitZ()), 15.0);
}

TEST(TangentPlanes, MaxDistanceLimitsNeighbours) {
  Points points;
  test::PlanarGrid().appendTo(points);
  TangentPlaneOptions options;
  options.neighbors = 1000;
  options.max_distance = 20.0;
  std::vector<Index> neighbors;
  growNeighborhood(NeighborGrid(points), {}, 31 * 15 + 15, options, neighbors);
  EXPECT_EQ(neighbors.size(), 13U);
}

TEST(TangentPlanes, ReachIsTheDistanceToTheFarthestNeighbour) {
  test::ThrownFold fold;
  fold.points.emplace_back(1e6, 0.0, 0.0);
  fold.points.emplace_back(std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0);
  const NeighborGrid grid(fold.points);
  TangentPlaneOptions options;
  options.rho_plus_delta = 30.0;
  const TangentPlanes planes = estimateTangentPlanes(grid, fold.faults, options);
  std::vector<Index> neighbors;
  for (std::size_t i = 0; i < fold.points.size(); ++i) {
    if (std::isnan(planes.curvature[i])) {
      EXPECT_TRUE(std::isnan(planes.reach[i]));
      continue;
    }
    growNeighborhood(grid, fold.faults, static_cast<Index>(i), options, neighbors);
    double farthest = 0.0;
    for (const Index n : neighbors)
      farthest = std::max(farthest, (fold.points[static_cast<std::size_t>(n)] - fold.points[i]).norm());
    ASSERT_FLOAT_EQ(planes.reach[i], static_cast<float>(farthest));
  }
}

/// The normal and the curvature by Eigen's iterative solver.
void expectAsBySolver(const Points& points, const NeighborGrid& grid, const TangentPlanes& planes, const TangentPlaneOptions& options) {
  std::vector<Index> neighbors;
  for (std::size_t i = 0; i < points.size(); ++i) {
    growNeighborhood(grid, {}, static_cast<Index>(i), options, neighbors);
    Vector3 mean = Vector3::Zero();
    for (const Index n : neighbors)
      mean += points[static_cast<std::size_t>(n)] / static_cast<double>(neighbors.size());
    Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
    for (const Index n : neighbors)
      scatter += (points[static_cast<std::size_t>(n)] - mean) * (points[static_cast<std::size_t>(n)] - mean).transpose();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scatter);
    const double gap = (solver.eigenvalues()[1] - solver.eigenvalues()[0]) / solver.eigenvalues()[2];
    ASSERT_LT(test::lineAngle(planes.normals[i], solver.eigenvectors().col(0)), 1e-11 / gap);
    ASSERT_NEAR(planes.curvature[i], solver.eigenvalues()[0] / solver.eigenvalues().sum(), 1e-7);
    ASSERT_LT((planes.centres[i] - mean).norm(), 1e-9);
  }
}

TEST(TangentPlanes, AsByAnIterativeSolverFromThinToThick) {
  TangentPlaneOptions options;
  for (const double noise : {0.0, 1e-6, 1.0, 10.0, 30.0, 300.0}) {
    const Points points = test::wavySheet(1000, 1000.0, noise);
    const NeighborGrid grid(points);
    expectAsBySolver(points, grid, estimateTangentPlanes(grid, {}, options), options);
    Points strip = points; // neighbours nearly on a line
    for (Vector3& p : strip)
      p.y() *= 0.001;
    const NeighborGrid strip_grid(strip);
    expectAsBySolver(strip, strip_grid, estimateTangentPlanes(strip_grid, {}, options), options);
  }
}

/// The paper's rule word by word: time after time the nearest point to the pick that is a step from the neighbours and in no place of theirs.
std::vector<Index> grownByTheRule(const Points& points, Index pick, const TangentPlaneOptions& options) {
  std::vector<Index> neighbors = {pick};
  const auto at = [&](Index i) { return points[static_cast<std::size_t>(i)]; };
  while (neighbors.size() < options.neighbors) {
    Index best = -1;
    for (Index q = 0; q < static_cast<Index>(points.size()); ++q) {
      double step = std::numeric_limits<double>::infinity();
      for (const Index n : neighbors)
        step = std::min(step, (at(n) - at(q)).norm());
      const bool joins = step > 0.0 && step < options.rho_plus_delta;
      if (joins && (best < 0 || (at(q) - at(pick)).squaredNorm() < (at(best) - at(pick)).squaredNorm()))
        best = q;
    }
    if (best < 0)
      break;
    neighbors.push_back(best);
  }
  return neighbors;
}

TEST(TangentPlanes, NeighboursByThePaperRuleWordByWord) {
  Points points = test::wavySheet(1500, 1000.0, 1.0);
  points.insert(points.end(), points.begin(), points.begin() + 50); // some picks twice
  const NeighborGrid grid(points);
  TangentPlaneOptions options;
  options.rho_plus_delta = 60.0; // about half of the picks have all their neighbours within it
  std::vector<Index> neighbors;
  for (Index i = 0; i < 100; ++i) {
    growNeighborhood(grid, {}, i, options, neighbors);
    ASSERT_EQ(neighbors, grownByTheRule(points, i, options));
  }
}

TEST(TangentPlanes, TheSameForAnyNumberOfThreads) {
  const Points points = test::wavySheet(20000, 1000.0, 1.0);
  const NeighborGrid grid(points);
  TangentPlaneOptions options;
  options.rho_plus_delta = 15.0;
  options.threads = 1;
  const TangentPlanes one = estimateTangentPlanes(grid, {}, options);
  options.threads = 4;
  const TangentPlanes four = estimateTangentPlanes(grid, {}, options);
  EXPECT_EQ(one.normals, four.normals);
  EXPECT_EQ(one.centres, four.centres);
  EXPECT_EQ(one.curvature, four.curvature);
}

/// A plane of picks with noise, and a measured normal at its middle.
struct MeasuredPlane {
  test::PlanarGrid grid = {10.0, 0.0, 300.0, 300.0, 0.3, -0.1, 0.0};
  Points points;
  TangentPlaneOptions options;
  Index middle = 15 * 31 + 15;

  explicit MeasuredPlane(const Vector3& normal) {
    grid.appendTo(points);
    test::Random random(3);
    for (Vector3& p : points)
      p.z() += random.normal(2.0);
    options.measured = {{middle, normal}};
  }
};

TEST(TangentPlanes, AMeasuredNormalIsKeptAndItsPlaneHoldsThePick) {
  const Vector3 normal = Vector3(0.5, 0.2, -2.0);
  MeasuredPlane cloud(normal);
  const TangentPlanes planes = planesOf(cloud.points, cloud.options);
  const auto pick = static_cast<std::size_t>(cloud.middle);
  EXPECT_LT((planes.normals[pick] - normal.normalized()).norm(), 1e-15);
  EXPECT_EQ(planes.centres[pick], cloud.points[pick]);
  EXPECT_GT(planes.reach[pick], 15.0F);
  EXPECT_GT(planes.curvature[pick], 0.0F);
  EXPECT_THAT(planes.measured, testing::ElementsAre(cloud.middle));
  EXPECT_TRUE(planesOf(cloud.points).measured.empty());
}

TEST(TangentPlanes, AMeasuredNormalTurnsThoseAroundItAndNoOthers) {
  MeasuredPlane cloud(-test::PlanarGrid{10.0, 0.0, 1.0, 1.0, 0.3, -0.1, 0.0}.normal());
  const TangentPlanes without = planesOf(cloud.points), with = planesOf(cloud.points, cloud.options);
  cloud.options.measured_weight = 100.0;
  const TangentPlanes strongly = planesOf(cloud.points, cloud.options);
  const NeighborGrid grid(cloud.points);
  std::vector<Index> neighbors;
  int turned = 0;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    growNeighborhood(grid, {}, static_cast<Index>(i), {}, neighbors);
    const bool near = std::find(neighbors.begin(), neighbors.end(), cloud.middle) != neighbors.end();
    if (!near || neighbors.back() == cloud.middle || static_cast<Index>(i) == cloud.middle) {
      ASSERT_TRUE(static_cast<Index>(i) == cloud.middle || with.normals[i] == without.normals[i]);
      continue;
    }
    ++turned;
    const Vector3 truth = cloud.grid.normal();
    EXPECT_LT(test::lineAngle(with.normals[i], truth), test::lineAngle(without.normals[i], truth));
    EXPECT_LT(test::lineAngle(strongly.normals[i], truth), test::lineAngle(with.normals[i], truth));
  }
  EXPECT_GE(turned, 8);
  // A neighbour 10 away with a reach of about 22: a weight of 0.8, so that it keeps about 1 / 1.8 of its error.
  const auto beside = static_cast<std::size_t>(cloud.middle + 1);
  const double share = test::lineAngle(with.normals[beside], cloud.grid.normal()) / test::lineAngle(without.normals[beside], cloud.grid.normal());
  EXPECT_GT(share, 0.4);
  EXPECT_LT(share, 0.7);
}

TEST(TangentPlanes, AFaultStopsAMeasuredNormal) {
  const test::ThrownFold fold;
  TangentPlaneOptions options;
  for (std::size_t i = 0; i < fold.left_count; ++i)
    options.measured.push_back({static_cast<Index>(i), Vector3::UnitX()});
  const TangentPlanes planes = planesOf(fold.points, options, fold.faults);
  for (std::size_t i = 0; i < fold.points.size(); ++i)
    ASSERT_LT(test::lineAngle(planes.normals[i], i < fold.left_count ? Vector3(Vector3::UnitX()) : fold.right.normal()), 1e-6);
}

TEST(TangentPlanes, MeasuredNormalsOfOnePlaceAreAveraged) {
  Points points = test::wavySheet(500, 100.0, 0.1);
  points.push_back(points[7]);
  TangentPlaneOptions options;
  options.measured = {{500, {0.1, 0.0, 1.0}}, {7, {0.1, 0.0, -1.0}}};
  const TangentPlanes planes = planesOf(points, options), at = estimateTangentPlanesAt(NeighborGrid(points), {}, options, points);
  EXPECT_THAT(planes.measured, testing::ElementsAre(7, 500));
  EXPECT_LT(test::lineAngle(planes.normals[7], Vector3::UnitZ()), 1e-6);
  EXPECT_EQ(planes.normals[7], planes.normals[500]);
  EXPECT_EQ(planes.normals, at.normals);
  EXPECT_EQ(planes.measured, at.measured);
}

TEST(TangentPlanes, AMeasuredNormalMakesAPlaneWhereTooFewPicksDo) {
  TangentPlaneOptions options;
  options.measured = {{0, Vector3::UnitZ()}};
  const TangentPlanes lonely = planesOf({{1, 2, 3}}, options);
  EXPECT_EQ(lonely.normals[0], Vector3(Vector3::UnitZ()));
  EXPECT_EQ(lonely.centres[0], Vector3(1, 2, 3));
  Points line;
  for (int i = 0; i < 30; ++i)
    line.emplace_back(3.0 * i, 0.0, 0.0);
  const TangentPlanes along = planesOf(line, options);
  EXPECT_LT(test::lineAngle(along.normals[1], Vector3::UnitZ()), 1e-6);
  EXPECT_TRUE(along.normals[29].hasNaN());
}

TEST(TangentPlanes, WrongMeasuredNormalsAreRefused) {
  const Points points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  TangentPlaneOptions options;
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  for (const MeasuredNormal& wrong : {MeasuredNormal{3, Vector3::UnitZ()}, MeasuredNormal{-1, Vector3::UnitZ()}, MeasuredNormal{0, Vector3::Zero()},
                                      MeasuredNormal{0, Vector3(0, nothing, 1)}}) {
    options.measured = {wrong};
    EXPECT_THROW(planesOf(points, options), InvalidInputError);
  }
  options.measured.clear();
  options.measured_weight = -1.0;
  EXPECT_THROW(planesOf(points, options), InvalidInputError);
}

TEST(TangentPlanes, OptionsOutOfRangeAreRefused) {
  const Points points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  TangentPlaneOptions options;
  options.neighbors = 2;
  EXPECT_THROW(planesOf(points, options), InvalidInputError);
  options = {};
  options.rho_plus_delta = -1.0;
  EXPECT_THROW(planesOf(points, options), InvalidInputError);
  std::vector<Index> neighbors;
  EXPECT_THROW(growNeighborhood(NeighborGrid(points), {}, 3, {}, neighbors), InvalidInputError);
}

} // namespace
} // namespace graben
