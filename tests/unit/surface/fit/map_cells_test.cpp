#include "fit/map_cells.h"

#include <gtest/gtest.h>

namespace graben {
namespace {

using detail::MapCells;

/// A grid of picks a unit apart over 40 x 40 without those in a disc.
Points gridWithHole(double radius) {
  Points picks;
  for (int x = 0; x <= 40; ++x)
    for (int y = 0; y <= 40; ++y)
      if (std::hypot(x - 20.0, y - 20.0) > radius)
        picks.emplace_back(x, y, 0.0);
  return picks;
}

TEST(MapCells, FindAHoleAndTheOutside) {
  const Points picks = gridWithHole(8.0);
  const MapCells cells(picks, boundsOf(picks, 1), 0.5, 2.0);
  ASSERT_EQ(cells.gaps().size(), 2U);
  EXPECT_TRUE(cells.gaps()[0].outside);
  EXPECT_FALSE(cells.gaps()[1].outside);
  EXPECT_NEAR(cells.gaps()[1].width, 16.5, 1.5);
}

TEST(MapCells, KnowNoHoleWherePicksAreWithinReach) {
  const Points picks = gridWithHole(1.5);
  const MapCells cells(picks, boundsOf(picks, 1), 0.5, 2.5);
  EXPECT_EQ(cells.gaps().size(), 1U);
}

TEST(MapCells, AroundAHoleReachItsPicksAndNoFarther) {
  const Points picks = gridWithHole(8.0);
  const MapCells cells(picks, boundsOf(picks, 1), 0.5, 2.0);
  const std::vector<char> around = cells.around({0, 1});
  const auto in = [&](double x, double y) { return around[static_cast<std::size_t>(cells.cellOf({x, y, 0.0}))] != 0; };
  EXPECT_TRUE(in(20.0, 20.0));
  EXPECT_TRUE(in(28.0, 21.0)) << "the picks at its rim";
  EXPECT_FALSE(in(31.5, 20.0));
  EXPECT_EQ(cells.cellOf({1000.0, 0.0, 0.0}), -1);
}

TEST(MapCells, TellHowFarAnOutlineIsFromPicks) {
  const Points picks = gridWithHole(0.0);
  Bounds area = boundsOf(picks, 1);
  area.extend({60.0, 0.0, 0.0});
  const MapCells cells(picks, area, 0.5, 2.0);
  const MapOutline outline({Points{{0.0, 0.0, 0.0}, {60.0, 0.0, 0.0}, {60.0, 40.0, 0.0}, {0.0, 40.0, 0.0}}});
  EXPECT_NEAR(cells.farthestWithin(outline), 20.0, 1.0);
}

} // namespace
} // namespace graben
