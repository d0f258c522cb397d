#include "clouds.h"
#include "graben/features/pick_layout.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace graben {
namespace {

double height(double x, double y) { return 20.0 * std::sin(x / 700.0) * std::cos(y / 500.0); }

/// Lines along x over the square [0, size]^2, turned by an angle.
struct Lines {
  double size = 4000.0;
  double distance = 500.0;
  double along = 12.5;
  double turn = 0.0;

  Points picks(double noise, bool both_ways = false) const {
    test::Random random(3);
    Points points;
    const auto add = [&](double a, double b) {
      const double x = std::cos(turn) * a - std::sin(turn) * b, y = std::sin(turn) * a + std::cos(turn) * b;
      points.emplace_back(x, y, height(x, y) + random.normal(noise));
    };
    for (double b = 0.0; b <= size; b += distance)
      for (double a = 0.0; a <= size; a += along) {
        add(a, b);
        if (both_ways)
          add(b, a);
      }
    return points;
  }
};

PickLayout layoutOf(const Points& points, unsigned threads = 0) { return pickLayout(NeighborGrid(points), threads); }

TEST(PickLayout, CloudsThatAreDenseInAllDirectionsHaveNoLines) {
  EXPECT_FALSE(layoutOf(test::wavySheet(5000, 1000.0, 2.0)).along_lines);
  EXPECT_FALSE(layoutOf(test::wavySheet(60000, 1000.0, 8.0)).along_lines) << "noise above the spacing";
  EXPECT_FALSE(layoutOf(Lines{2000.0, 25.0, 25.0}.picks(1.0)).along_lines) << "a grid";
  EXPECT_FALSE(layoutOf(Lines{2000.0, 50.0, 25.0}.picks(1.0)).along_lines) << "a grid of oblong bins";
}

TEST(PickLayout, LinesAreFoundAtAnyAngleAndDistance) {
  for (const double distance : {250.0, 500.0, 1000.0})
    for (const double turn : {0.0, 0.4, 1.2}) {
      const PickLayout layout = layoutOf(Lines{6000.0, distance, 12.5, turn}.picks(2.0));
      ASSERT_TRUE(layout.along_lines) << distance << " " << turn;
      EXPECT_NEAR(layout.along, 12.5, 1.0);
      EXPECT_GT(layout.line_distance, distance / 1.5) << turn;
      EXPECT_LT(layout.line_distance, distance * 1.5) << turn;
      EXPECT_GT(layout.share, 0.99);
    }
}

TEST(PickLayout, CrossingLinesAreNoDenserThanTheirDistance) {
  const PickLayout layout = layoutOf(Lines{5000.0, 500.0, 12.5, 0.3}.picks(2.0, true));
  ASSERT_TRUE(layout.along_lines);
  EXPECT_GT(layout.line_distance, 300.0);
  EXPECT_LT(layout.line_distance, 750.0);
}

TEST(PickLayout, ADensePatchAmongLinesStaysDense) {
  Points points = Lines{6000.0, 500.0}.picks(1.0);
  const std::size_t on_lines = points.size();
  for (double x = 2000.0; x < 3500.0; x += 12.5)
    for (double y = 2010.0; y < 3500.0; y += 12.5)
      points.emplace_back(x, y, height(x, y));
  const PickLayout layout = layoutOf(points);
  ASSERT_TRUE(layout.along_lines);
  std::size_t dense = 0, lines = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool inside = points[i].x() > 2100.0 && points[i].x() < 3400.0 && points[i].y() > 2100.0 && points[i].y() < 3400.0;
    const bool far = points[i].x() < 1200.0 || points[i].x() > 4300.0 || points[i].y() < 1200.0 || points[i].y() > 4300.0;
    if (inside && i >= on_lines)
      dense += layout.line_distances[i] > 0.0F ? 1 : 0;
    if (far)
      lines += layout.line_distances[i] > 0.0F ? 0 : 1;
  }
  EXPECT_EQ(dense, 0U) << "picks of the patch taken for lines";
  EXPECT_EQ(lines, 0U) << "picks on lines taken for dense";
}

TEST(PickLayout, IsTheSameForEveryNumberOfThreads) {
  const Points points = Lines{}.picks(2.0, true);
  EXPECT_EQ(layoutOf(points, 1).line_distances, layoutOf(points, 3).line_distances);
}

TEST(PickLayout, OddCloudsHaveNoLines) {
  EXPECT_FALSE(layoutOf({}).along_lines);
  EXPECT_FALSE(layoutOf(Points(200, Vector3(1.0, 2.0, 3.0))).along_lines) << "one place";
  Points nan = test::wavySheet(500, 100.0, 0.1);
  for (std::size_t i = 0; i < nan.size(); i += 3)
    nan[i].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(layoutOf(nan).along_lines);
}

} // namespace
} // namespace graben
