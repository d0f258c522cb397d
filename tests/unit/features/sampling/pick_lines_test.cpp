#include "clouds.h"
#include "graben/features/pick_lines.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace graben {
namespace {

/// Picks on lines, and the line that each was made on.
struct Picks {
  Points points;
  std::vector<int> made_on;
  int lines = 0;

  /// \param[in] bend of the line, by so much at its middle
  void addLine(const Vector3& from, const Vector3& to, double bend = 0.0) {
    const double length = (to - from).norm();
    const Vector3 aside = Vector3((to - from).y(), (from - to).x(), 0.0) / length;
    for (double way = 0.0; way <= length; way += 12.5) {
      points.push_back(from + way / length * (to - from) + bend * std::sin(M_PI * way / length) * aside);
      points.back().z() = 20.0 * std::sin(points.back().x() / 700.0);
      made_on.push_back(lines);
    }
    ++lines;
  }

  std::vector<Index> found(unsigned threads = 0) const { return pickLines(points, pickLayout(NeighborGrid(points), threads), threads); }

  /// The share of picks whose line has mostly picks of the line that they were made on, and no other line has as many of these.
  double rightShare() const {
    const std::vector<Index> line = found();
    std::map<std::pair<Index, int>, double> count;
    for (std::size_t i = 0; i < line.size(); ++i)
      count[{line[i], made_on[i]}] += line[i] < 0 ? 0.0 : 1.0;
    double right = 0.0;
    for (int made = 0; made < lines; ++made) {
      double most = 0.0;
      for (const auto& [pair, picks] : count)
        if (pair.second == made)
          most = std::max(most, picks);
      right += most;
    }
    return right / static_cast<double>(line.size());
  }
};

/// A net of lines, of which those along y bend.
Picks net(double turn, double bend) {
  const auto turned = [turn](double x, double y) {
    return Vector3(std::cos(turn) * x - std::sin(turn) * y, std::sin(turn) * x + std::cos(turn) * y, 0.0);
  };
  Picks picks;
  for (double at = 0.0; at <= 4000.0; at += 500.0) {
    picks.addLine(turned(at, 0.0), turned(at, 4000.0), bend);
    picks.addLine(turned(0.0, at), turned(4000.0, at));
  }
  return picks;
}

TEST(PickLines, LinesThatCrossAreToldApart) {
  EXPECT_GT(net(0.0, 0.0).rightShare(), 0.98);
  EXPECT_GT(net(0.5, 0.0).rightShare(), 0.98);
}

TEST(PickLines, ALineMayBend) { EXPECT_GT(net(0.3, 300.0).rightShare(), 0.98); }

TEST(PickLines, LinesHaveNumbersInTheOrderOfTheirFirstPoints) {
  const Picks picks = net(0.0, 0.0);
  const std::vector<Index> line = picks.found();
  EXPECT_EQ(line.front(), 0);
  EXPECT_EQ(*std::max_element(line.begin(), line.end()), picks.lines - 1);
  EXPECT_EQ(line, picks.found(3));
}

TEST(PickLines, PicksThatLieDenseAreOnNone) {
  const Points points = test::wavySheet(5000, 1000.0, 2.0);
  const std::vector<Index> line = pickLines(points, pickLayout(NeighborGrid(points)));
  EXPECT_EQ(line, std::vector<Index>(points.size(), -1));
}

TEST(PickLines, PointsThatAreNotFiniteAreOnNone) {
  Picks picks = net(0.0, 0.0);
  picks.points[3].setConstant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(picks.found()[3], -1);
}

} // namespace
} // namespace graben
