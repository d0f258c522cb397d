#include "graben/analysis/fault_throw.h"

#include "graben/core/errors.h"

#include <gtest/gtest.h>

#include <cmath>

namespace graben {
namespace {

const double kTan = std::tan(60.0 / 180.0 * M_PI);

/// A plane that dips 60 degrees towards +x and passes through x = 0 at z = 0.
Vector3 onFault(double y, double z) { return {-z / kTan, y, z}; }

FaultNetwork fault() {
  TriangleMesh mesh;
  mesh.vertices = {onFault(-100, -500), onFault(-100, 500), onFault(1100, 500), onFault(1100, -500)};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return FaultNetwork({FaultSurface::fromMesh("f", mesh)});
}

CutoffLine line(int side, const Points& points) {
  CutoffLine l;
  l.fault = 0;
  l.side = side;
  l.points = points;
  return l;
}

TEST(FaultThrow, IsReadAcrossTheStrike) {
  Points footwall;
  Points hanging_wall;
  for (int i = 0; i <= 10; ++i)
    footwall.push_back(onFault(100.0 * i, 40.0));
  for (int i = 4; i >= -1; --i)
    hanging_wall.push_back(onFault(200.0 * i + 50.0, 40.0 - (200.0 * i + 50.0) / 10.0));
  const auto throws = readThrows({line(-1, footwall), line(1, hanging_wall)}, fault());
  ASSERT_EQ(throws.size(), 1U);
  ASSERT_EQ(throws[0].size(), 9U) << "the other side ends at y = 850";
  for (const ThrowSample& s : throws[0]) {
    const double expected = s.footwall.y() / 10.0;
    EXPECT_NEAR(s.throw_, expected, 1e-9);
    EXPECT_NEAR(s.heave, expected / kTan, 1e-9);
    EXPECT_NEAR(s.dip_slip, expected / std::sin(60.0 / 180.0 * M_PI), 1e-9);
    EXPECT_NEAR(s.along, s.footwall.y(), 1e-9);
    EXPECT_NEAR(s.hanging_wall.y(), s.footwall.y(), 1e-9);
  }
  const ThrowSummary summary = summarize(throws[0]);
  EXPECT_EQ(summary.samples, 9U);
  EXPECT_NEAR(summary.max, 80.0, 1e-9);
  EXPECT_NEAR(summary.max_at.y(), 800.0, 1e-9);
  EXPECT_NEAR(summary.min, 0.0, 1e-9);
  EXPECT_NEAR(summary.mean, 40.0, 1e-9);
  EXPECT_NEAR(summary.length, 800.0, 1e-9);
}

TEST(FaultThrow, OfAReverseFaultIsNegative) {
  const auto throws = readThrows({line(-1, {onFault(0, -30), onFault(1000, -30)}), line(1, {onFault(1000, 30), onFault(0, 30)})}, fault());
  ASSERT_EQ(throws[0].size(), 2U);
  EXPECT_NEAR(throws[0][0].throw_, -60.0, 1e-9);
  EXPECT_NEAR(throws[0][0].heave, -60.0 / kTan, 1e-9);
  EXPECT_LT(throws[0][0].dip_slip, -60.0);
}

TEST(FaultThrow, IsNothingWhereThereIsOneSideOnly) {
  EXPECT_TRUE(readThrows({line(-1, {onFault(0, 0), onFault(1000, 0)})}, fault())[0].empty());
  EXPECT_EQ(summarize({}).samples, 0U);
}

/// The way from one line to the other must run along the fault, not through the air beside its bend.
TEST(FaultThrow, DoesNotReachOverToAnotherLimbOfTheFault) {
  const auto throws = readThrows({line(-1, {onFault(0, 0), onFault(1000, 0)}), line(1, {Vector3(400, 1000, 20), Vector3(400, 0, 20)})}, fault());
  EXPECT_TRUE(throws[0].empty());
}

/// Both limbs of a fold face their own counterpart, though the other limb's may be nearer.
TEST(FaultThrow, PairsLimbsOfTheSameWayUp) {
  const double drop = 100.0;
  const Points fold = {onFault(0, 0), onFault(600, 0), onFault(600, 90), onFault(0, 90)};
  Points lower;
  for (const Vector3& p : fold)
    lower.insert(lower.begin(), onFault(p.y() > 300.0 ? 610.0 : -10.0, p.z() - drop));
  const auto throws = readThrows({line(-1, {fold[0], onFault(300, 0), fold[1]}), line(-1, {fold[2], onFault(300, 90), fold[3]}), line(1, lower)}, fault());
  ASSERT_EQ(throws[0].size(), 6U);
  for (const ThrowSample& s : throws[0])
    EXPECT_NEAR(s.throw_, drop, 1e-9);
}

/// A crumb of a line beside the long one, and what lies next to another fault, tell nothing of the throw.
TEST(FaultThrow, CountsNeitherCrumbsNorJunctionsNorExtrapolatedCutoffs) {
  TriangleMesh crossing;
  crossing.vertices = {{-500, 5, -500}, {-500, 5, 500}, {500, 5, 500}, {500, 5, -500}};
  crossing.triangles = {{0, 1, 2}, {0, 2, 3}};
  FaultNetwork both({fault().fault(0), FaultSurface::fromMesh("g", crossing)});
  CutoffLine footwall = line(-1, {});
  CutoffLine hanging_wall = line(1, {});
  for (int i = 0; i <= 40; ++i) {
    const double throw_ = i == 0 ? 3.0 : i > 30 ? 500.0 : 60.0;
    footwall.points.push_back(onFault(20.0 * i, 30.0));
    footwall.pick_distance.push_back(i > 30 ? 90.0F : 10.0F);
    hanging_wall.points.insert(hanging_wall.points.begin(), onFault(20.0 * i, 30.0 - throw_));
    hanging_wall.pick_distance.push_back(10.0F);
  }
  const CutoffLine crumb = line(-1, {onFault(400, 20), onFault(401, 20)});
  const ThrowSummary s = summarize(readThrows({footwall, crumb, hanging_wall}, both, {50.0})[0]);
  EXPECT_NEAR(s.mean, 60.0, 1e-9);
  EXPECT_NEAR(s.min, 60.0, 1e-9);
  EXPECT_NEAR(s.length, 800.0, 1e-9);
  EXPECT_EQ(s.samples + s.left_out, 41U);
  EXPECT_FALSE(s.extrapolated);
  const ThrowSummary far = summarize(readThrows({footwall, crumb, hanging_wall}, both, {5.0})[0]);
  EXPECT_TRUE(far.extrapolated) << "nearly all are: better than nothing, and said";
  EXPECT_GT(far.samples, 30U);
}

TEST(FaultThrow, WantsSides) {
  EXPECT_THROW(readThrows({line(0, {onFault(0, 0), onFault(1000, 0)})}, fault()), InvalidInputError);
  CutoffLine stray = line(1, {onFault(0, 0), onFault(1000, 0)});
  stray.fault = 1;
  EXPECT_THROW(readThrows({stray}, fault()), InvalidInputError);
}

} // namespace
} // namespace graben
