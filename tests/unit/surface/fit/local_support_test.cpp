#include "shapes.h"

#include "graben/surface/local_fit.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <algorithm>

namespace graben {
namespace {

/// Noisy picks on a hill, their normals a little off, some the wrong way round; in the order given, or shuffled along no curve.
struct Picks {
  TangentPlanes planes;
  NeighborGrid grid;
  FaultNetwork faults;

  explicit Picks(bool in_order) {
    test::Random random(3);
    Points points;
    for (int i = 0; i < 3000; ++i) {
      const double x = random.uniform(-10.0, 10.0), y = random.uniform(-10.0, 10.0);
      points.emplace_back(x, y, 0.03 * x * x - 0.02 * x * y + random.normal(0.05));
    }
    if (in_order) {
      const std::vector<Index> order = spaceOrder(points);
      Points sorted;
      for (const Index i : order)
        sorted.push_back(points[static_cast<std::size_t>(i)]);
      points = sorted;
    }
    planes.centres = points;
    for (std::size_t i = 0; i < points.size(); ++i)
      planes.normals.push_back((i % 11 == 0 ? -1.0 : 1.0) * Vector3(random.normal(0.1), random.normal(0.1), 1.0).normalized());
    grid = NeighborGrid(planes.centres);
  }
};

class LocalSupport : public testing::TestWithParam<bool> {
protected:
  Picks picks{GetParam()};
  LocalFit fit{picks.grid, picks.planes, picks.faults, 50.0};
  LocalFit::Scratch scratch;
};

TEST_P(LocalSupport, HoldsThePicksInReachThatFaceTheRightWay) {
  ASSERT_EQ(picks.grid.inOrder(), GetParam());
  LocalSurface frame = frameAt({1.0, -2.0, 0.1}, Vector3(0.1, -0.1, 1.0).normalized());
  const double radius = fit.gather(frame, frame.centre, 200, scratch);
  ASSERT_GE(scratch.count, 200U);
  std::vector<Index> found(scratch.index.begin(), scratch.index.begin() + static_cast<std::ptrdiff_t>(scratch.count));
  double reach = 0.0;
  for (std::size_t i = 0; i < scratch.count; ++i) {
    const Vector3 d = picks.planes.centres[static_cast<std::size_t>(scratch.index[i])] - frame.centre;
    EXPECT_NEAR(scratch.u[i], d.dot(frame.u), 1e-12);
    EXPECT_NEAR(scratch.v[i], d.dot(frame.v), 1e-12);
    EXPECT_NEAR(scratch.height[i], d.dot(frame.normal), 1e-12);
    EXPECT_NEAR(scratch.squared[i], d.squaredNorm() - std::pow(d.dot(frame.normal), 2), 1e-11);
    reach = std::max(reach, d.norm());
  }
  EXPECT_GE(reach, 0.9 * radius);
  std::vector<Index> expected;
  for (std::size_t i = 0; i < picks.planes.centres.size(); ++i)
    if ((picks.planes.centres[i] - frame.centre).norm() <= reach && picks.planes.normals[i].dot(frame.normal) > 0.34)
      expected.push_back(static_cast<Index>(i));
  std::sort(found.begin(), found.end());
  EXPECT_EQ(found, expected);
}

TEST_P(LocalSupport, PolynomialsAreThoseOfLeastSquares) {
  LocalSurface surface = frameAt({1.0, -2.0, 0.1}, Vector3(0.1, -0.1, 1.0).normalized());
  fit.gather(surface, surface.centre, 120, scratch);
  const std::size_t all = scratch.count;
  for (const int degree : {1, 2, 3})
    for (const std::size_t fewer : {0U, 1U, 2U, 3U, 40U}) {
      scratch.count = all - fewer;
      fit.solve(surface, {degree, 120}, scratch);
      ASSERT_TRUE(surface.valid);
      const Eigen::Index rows = static_cast<Eigen::Index>(scratch.count), terms = (degree + 1) * (degree + 2) / 2;
      Eigen::MatrixXd a(rows, terms);
      Eigen::VectorXd heights(rows);
      for (Eigen::Index i = 0; i < rows; ++i) {
        const auto p = static_cast<std::size_t>(i);
        const double u = scratch.u[p] / surface.radius, v = scratch.v[p] / surface.radius;
        const double root = std::max(0.0, 1.0 - u * u - v * v); // of the weight
        Eigen::Index column = 0;
        for (int order = 0; order <= degree; ++order)
          for (int b = 0; b <= order; ++b)
            a(i, column++) = root * std::pow(u, order - b) * std::pow(v, b);
        heights[i] = root * scratch.height[p];
      }
      const Eigen::VectorXd expected = a.colPivHouseholderQr().solve(heights);
      for (Eigen::Index c = 0; c < terms; ++c)
        EXPECT_NEAR(surface.coefficients[static_cast<std::size_t>(c)], expected[c], 1e-3) << degree << ' ' << fewer << ' ' << c;
    }
}

TEST_P(LocalSupport, SolvingLeavesThePicksGatheredAsTheyAre) {
  LocalSurface surface = frameAt({1.0, -2.0, 0.1}, Vector3::UnitZ());
  fit.gather(surface, surface.centre, 120, scratch);
  const std::vector<double> u = scratch.u, height = scratch.height, squared = scratch.squared;
  scratch.count = 61;
  fit.solve(surface, {2, 61}, scratch);
  for (std::size_t i = 0; i < 120; ++i) {
    EXPECT_EQ(scratch.u[i], u[i]);
    EXPECT_EQ(scratch.height[i], height[i]);
    EXPECT_EQ(scratch.squared[i], squared[i]);
  }
}

INSTANTIATE_TEST_SUITE_P(Orders, LocalSupport, testing::Bool(), [](const auto& order) { return order.param ? "InOrder" : "AsTheyCome"; });

} // namespace
} // namespace graben
