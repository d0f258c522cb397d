#include "graben/filters/fault_distance.h"

#include "band_distances.h"

#include "graben/core/errors.h"
#include "graben/features/neighbor_grid.h"
#include "unit/filters/two_sheets.h"

#include <gtest/gtest.h>

#include <cmath>

namespace graben {
namespace {

constexpr double NOT_FINITE = std::numeric_limits<double>::quiet_NaN();

/// Two sheets with points that are not finite and one very far away among them.
struct Case {
  Case() {
    const Points in_order = sheets.points;
    const std::vector<Index> order = spaceOrder(in_order);
    for (std::size_t i = 0; i < order.size(); ++i)
      sheets.points[i] = in_order[static_cast<std::size_t>(order[i])];
    sheets.points[100].setConstant(NOT_FINITE);
    sheets.points[900].x() = std::numeric_limits<double>::infinity();
    sheets.points[700].y() = 1e300;
  }
  test::TwoSheets sheets;
};

TEST(FaultDistance, SameAsPickByPick) {
  const Case c;
  const FaultNetwork faults({test::TwoSheets::faultAt(0.0), test::TwoSheets::faultAt(110.0, 50.0)});
  for (const double limit : {0.0, 5.0, 62.0, 300.0, std::numeric_limits<double>::infinity()})
    for (const unsigned threads : {1U, 2U}) {
      std::vector<Index> near;
      std::vector<double> distances;
      for (std::size_t i = 0; i < c.sheets.points.size(); ++i) {
        const FaultPoint nearest = faults.nearest(c.sheets.points[i], limit);
        distances.push_back(nearest.fault < 0 ? std::numeric_limits<double>::infinity() : nearest.distance);
        if (nearest.fault >= 0)
          near.push_back(static_cast<Index>(i));
      }
      EXPECT_EQ(distancesToFaults(c.sheets.points, faults, limit, threads), distances) << limit;
      EXPECT_EQ(picksWithin(c.sheets.points, faults, limit, threads), near) << limit;
    }
}

TEST(FaultDistance, OnlyThePicksAskedForInTheirOrder) {
  const Case c;
  const std::vector<Index> order{30, 100, 2, 700, 30};
  std::vector<Index> found;
  for (const PickNearFault& near : picksNearFaults(c.sheets.points, c.sheets.faults, 1e4, &order)) {
    found.push_back(near.pick);
    EXPECT_EQ(near.distance, c.sheets.faults.nearest(c.sheets.points[static_cast<std::size_t>(near.pick)]).distance);
  }
  EXPECT_EQ(found, (std::vector<Index>{30, 2, 30}));
}

TEST(FaultDistance, KeptForTheFewThatHaveOne) {
  std::vector<PickNearFault> near;
  std::vector<double> expected(1000, std::numeric_limits<double>::infinity());
  for (const Index pick : {999, 0, 63, 64, 65, 127, 128, 500})
    near.push_back({pick, expected[static_cast<std::size_t>(pick)] = 0.5 * pick + 1.0});
  const detail::BandDistances distances(expected.size(), near);
  for (std::size_t i = 0; i < expected.size(); ++i)
    ASSERT_EQ(distances[i], expected[i]) << i;
}

TEST(FaultDistance, RejectsLimitsOutOfRange) {
  EXPECT_THROW(picksWithin({}, {}, -1.0), InvalidInputError);
  EXPECT_THROW(distancesToFaults({}, {}, NOT_FINITE), InvalidInputError);
  EXPECT_TRUE(picksWithin({Vector3::Zero()}, {}, 1.0).empty());
}

} // namespace
} // namespace graben
