#include "synthetic_case.h"
#include "two_sheets.h"

#include "graben/core/errors.h"
#include "graben/filters/fault_distance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace graben {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

WrongSideResult search(const Points& points, const FaultNetwork& faults,
                       const WrongSideOptions& options = {}) {
  return findWrongSidePicks(NeighborGrid(points), faults, options);
}

PickReason reasonOf(const WrongSideResult& result, Index pick) {
  return result.reasons[static_cast<std::size_t>(pick)];
}

TEST(WrongSidePicks, GivesEachPickItsReasonAndCounts) {
  test::TwoSheets sheets;
  const Index wrong = sheets.add(6.0, 3.0, 0.0);
  const Index also_wrong = sheets.add(-8.0, 52.0, 39.0);
  const Index smeared = sheets.add(0.5, -40.0, 18.0);
  const WrongSideResult result = search(sheets.points, sheets.faults);
  EXPECT_EQ(reasonOf(result, wrong), PickReason::WrongSide);
  EXPECT_EQ(reasonOf(result, also_wrong), PickReason::WrongSide);
  EXPECT_EQ(reasonOf(result, smeared), PickReason::Smeared);
  EXPECT_EQ(result.wrong_side, 2U);
  EXPECT_EQ(result.smeared, 1U);
  EXPECT_EQ(result.flagged_by_fault, std::vector<std::size_t>{3});
  for (std::size_t i = 0; i < sheets.points.size(); ++i)
    ASSERT_EQ(result.reasons[i] != PickReason::Good, i >= sheets.points.size() - 3);
  ASSERT_EQ(result.flagged.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(result.flagged[i].pick, wrong + static_cast<Index>(i));
    EXPECT_EQ(result.flagged[i].fault, 0);
  }
}

TEST(WrongSidePicks, LeavesOutliersAloneThatNoFaultExplains) {
  test::TwoSheets sheets;
  const Index below = sheets.add(-6.0, 0.0, -35.0);
  const Index above = sheets.add(6.0, 100.0, 75.0);
  const WrongSideResult result = search(sheets.points, sheets.faults);
  EXPECT_EQ(reasonOf(result, below), PickReason::Good);
  EXPECT_EQ(reasonOf(result, above), PickReason::Good);
}

TEST(WrongSidePicks, JudgesAPickExactlyOnAFaultByBothSides) {
  test::TwoSheets sheets;
  const Index low = sheets.add(0.0, 0.0, 0.0);
  const Index high = sheets.add(0.0, 50.0, 40.0);
  const Index between = sheets.add(0.0, -50.0, 20.0);
  const WrongSideResult result = search(sheets.points, sheets.faults);
  EXPECT_EQ(reasonOf(result, low), PickReason::Good);
  EXPECT_EQ(reasonOf(result, high), PickReason::Good);
  EXPECT_EQ(reasonOf(result, between), PickReason::Smeared);
}

TEST(WrongSidePicks, TellsASheetBeyondTwoFaults) {
  test::TwoSheets sheets;
  for (Vector3& p : sheets.points)
    if (p.x() > 20.0)
      p.z() = 90.0;
  const FaultNetwork faults({test::TwoSheets::faultAt(0.0), test::TwoSheets::faultAt(20.0)});
  const Index across = sheets.add(24.0, 3.0, 0.5);
  const WrongSideResult result = search(sheets.points, faults);
  EXPECT_EQ(reasonOf(result, across), PickReason::WrongSide);
  ASSERT_EQ(result.flagged.size(), 1U);
  EXPECT_EQ(result.flagged.front().fault, 1) << "the nearer of the two";
}

TEST(WrongSidePicks, ANarrowWedgeGoesByItsMajority) {
  test::TwoSheets sheets;
  for (Vector3& p : sheets.points)
    if (p.x() > 40.0)
      p.z() = 80.0;
  const FaultNetwork faults({test::TwoSheets::faultAt(0.0), test::TwoSheets::faultAt(40.0)});
  const Index from_left = sheets.add(18.5, 3.0, 0.0);
  const WrongSideResult result = search(sheets.points, faults);
  EXPECT_EQ(reasonOf(result, from_left), PickReason::WrongSide);
  EXPECT_EQ(result.wrong_side + result.smeared, 1U);
}

TEST(WrongSidePicks, SaysNothingAboutPicksBesideAFault) {
  test::TwoSheets sheets;
  TriangleMesh below = sheets.faults.fault(0).mesh; // reaches up to z = 22 only
  for (Vector3& p : below.vertices)
    p.z() = std::min(p.z(), 22.0);
  const Index over = sheets.add(4.0, 3.0, 25.0);
  const FaultNetwork stops_short({FaultSurface::fromMesh("F", below)});
  const WrongSideResult result = search(sheets.points, stops_short);
  EXPECT_EQ(reasonOf(result, over), PickReason::Good);
  const WrongSideResult whole = search(sheets.points, sheets.faults);
  EXPECT_EQ(reasonOf(whole, over), PickReason::Smeared) << "were it not for the border";
}

TEST(WrongSidePicks, FollowsDragTowardsTheFault) {
  test::TwoSheets sheets;
  for (Vector3& p : sheets.points) {
    const double bent = 12.0 * std::exp(-std::abs(p.x()) / 60.0);
    p.z() += p.x() < 0.0 ? bent : -bent;
  }
  const WrongSideResult result = search(sheets.points, sheets.faults);
  EXPECT_EQ(result.wrong_side + result.smeared, 0U);
}

TEST(WrongSidePicks, BandAndToleranceDecideWhatIsLookedAt) {
  test::TwoSheets sheets;
  const Index wrong = sheets.add(15.0, 3.0, 0.0);
  WrongSideOptions options;
  options.band = 12.0;
  EXPECT_EQ(reasonOf(search(sheets.points, sheets.faults, options), wrong), PickReason::Good);
  options = {};
  options.tolerance = 45.0;
  EXPECT_EQ(reasonOf(search(sheets.points, sheets.faults, options), wrong), PickReason::Good);
  options.tolerance = 10.0;
  EXPECT_EQ(reasonOf(search(sheets.points, sheets.faults, options), wrong), PickReason::WrongSide);
  options.sigma = 12.0;
  EXPECT_EQ(reasonOf(search(sheets.points, sheets.faults, options), wrong), PickReason::Good);
}

TEST(WrongSidePicks, SaysWhatItUsed) {
  test::TwoSheets sheets;
  const WrongSideResult result = search(sheets.points, sheets.faults);
  EXPECT_NEAR(result.used.mean_distance, 10.0, 1.5);
  EXPECT_DOUBLE_EQ(result.used.band, 4.0 * result.used.mean_distance);
  EXPECT_DOUBLE_EQ(result.used.tolerance, 0.1 * result.used.mean_distance);
  EXPECT_EQ(result.judged, 8U * 41U);
}

TEST(WrongSidePicks, SameForAnyNumberOfThreads) {
  SyntheticOptions options = SyntheticOptions::of(SyntheticKind::Branch);
  options.picks = 10000;
  options.fault_shift = 60.0;
  const test::SyntheticCase job(options);
  WrongSideOptions search_options;
  search_options.threads = 1;
  const WrongSideResult one = findWrongSidePicks(job.grid, *job.faults, search_options);
  search_options.threads = 5;
  const WrongSideResult five = findWrongSidePicks(job.grid, *job.faults, search_options);
  EXPECT_GT(one.wrong_side, 100U);
  EXPECT_EQ(one.reasons, five.reasons);
  EXPECT_TRUE(std::equal(one.flagged.begin(), one.flagged.end(), five.flagged.begin(), five.flagged.end(),
                         [](const FlaggedPick& a, const FlaggedPick& b) { return a.pick == b.pick && a.fault == b.fault; }));
  EXPECT_EQ(one.used.sigma, five.used.sigma);
}

TEST(WrongSidePicks, SameWherePicksNearFaultsAreKnown) {
  test::TwoSheets sheets;
  sheets.add(6.0, 3.0, 0.0);
  Points points;
  for (const Index i : spaceOrder(sheets.points))
    points.push_back(sheets.points[static_cast<std::size_t>(i)]);
  const NeighborGrid grid(points);
  const WrongSideResult expected = findWrongSidePicks(grid, sheets.faults);
  EXPECT_EQ(expected.wrong_side, 1U);
  for (const double limit : {0.5 * expected.used.band, expected.used.band, 3.0 * expected.used.band}) {
    const std::vector<Index> near = picksWithin(points, sheets.faults, limit);
    const WrongSideResult found = findWrongSidePicks(grid, sheets.faults, {}, {&near, limit});
    EXPECT_EQ(found.reasons, expected.reasons);
    EXPECT_EQ(found.judged, expected.judged);
  }
}

TEST(WrongSidePicks, WorksInAnyUnitAndFarFromTheOrigin) {
  test::TwoSheets sheets;
  const Index wrong = sheets.add(6.0, 3.0, 0.0);
  for (const double scale : {1e-3, 1.0, 1e4}) {
    const Vector3 origin = scale * Vector3(46160.0, 592688.0, -200.0);
    Points points;
    for (const Vector3& p : sheets.points)
      points.push_back(scale * p + origin);
    TriangleMesh mesh = sheets.faults.fault(0).mesh;
    for (Vector3& p : mesh.vertices)
      p = scale * p + origin;
    const FaultNetwork faults({FaultSurface::fromMesh("F", mesh)});
    const WrongSideResult result = search(points, faults);
    EXPECT_EQ(reasonOf(result, wrong), PickReason::WrongSide) << scale;
    EXPECT_EQ(result.wrong_side + result.smeared, 1U) << scale;
  }
}

TEST(WrongSidePicks, NothingToJudgeIsNoError) {
  test::TwoSheets sheets;
  EXPECT_TRUE(search({}, sheets.faults).reasons.empty());
  EXPECT_EQ(search(sheets.points, {}).judged, 0U);
  EXPECT_EQ(search(sheets.points, {}).reasons.size(), sheets.points.size());
  EXPECT_EQ(search({{1.0, 0.0, 0.0}}, sheets.faults).wrong_side, 0U);
  EXPECT_EQ(search({{1.0, 0.0, 0.0}, {-1.0, 0.0, 9.0}, {2.0, 1.0, 3.0}}, sheets.faults).judged, 3U);
}

TEST(WrongSidePicks, SurvivesRepeatsLinesAndPointsThatAreNotFinite) {
  test::TwoSheets sheets;
  const Points once = sheets.points;
  sheets.points.insert(sheets.points.end(), once.begin(), once.end());
  sheets.points.insert(sheets.points.end(), 3000, Vector3(3.0, 0.0, 0.0));
  for (const double bad : {kNaN, std::numeric_limits<double>::infinity()})
    sheets.points.emplace_back(1.0, bad, 0.0);
  const WrongSideResult result = search(sheets.points, sheets.faults);
  EXPECT_EQ(result.reasons.size(), sheets.points.size());
  EXPECT_EQ(result.reasons.back(), PickReason::Good);
  for (std::size_t i = 0; i < 2 * once.size(); ++i)
    ASSERT_EQ(result.reasons[i], PickReason::Good);
  Points line;
  for (int i = -50; i < 50; ++i)
    line.emplace_back(10.0 * i, 0.0, i < 0 ? 0.0 : 40.0);
  EXPECT_EQ(search(line, sheets.faults).wrong_side, 0U);
  EXPECT_EQ(search(Points(50, Vector3::Zero()), sheets.faults).wrong_side, 0U);
}

TEST(WrongSidePicks, AllPicksWithinTheBandAreJudgedByTheMajority) {
  test::TwoSheets sheets;
  const Index wrong = sheets.add(6.0, 3.0, 0.0);
  WrongSideOptions options;
  options.band = 1000.0;
  const WrongSideResult result = search(sheets.points, sheets.faults, options);
  EXPECT_EQ(result.judged, sheets.points.size());
  EXPECT_EQ(reasonOf(result, wrong), PickReason::WrongSide);
  EXPECT_EQ(result.wrong_side + result.smeared, 1U);
}

TEST(WrongSidePicks, RejectsOptionsOutOfRange) {
  test::TwoSheets sheets;
  for (const double bad : {-1.0, kNaN, std::numeric_limits<double>::infinity()}) {
    WrongSideOptions options;
    options.band = bad;
    EXPECT_THROW(search(sheets.points, sheets.faults, options), InvalidInputError);
    options = {};
    options.mean_distance = bad;
    EXPECT_THROW(search(sheets.points, sheets.faults, options), InvalidInputError);
  }
}

TEST(WrongSidePicks, ExtremeLengthsDoNotHang) {
  test::TwoSheets sheets;
  for (const double length : {5e-324, 1e-300, 1e300}) {
    WrongSideOptions options;
    options.mean_distance = length;
    EXPECT_EQ(search(sheets.points, sheets.faults, options).wrong_side, 0U) << length;
  }
}

} // namespace
} // namespace graben
