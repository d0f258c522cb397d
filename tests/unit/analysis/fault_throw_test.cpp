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

TEST(FaultThrow, WantsSides) {
  EXPECT_THROW(readThrows({line(0, {onFault(0, 0), onFault(1000, 0)})}, fault()), InvalidInputError);
  CutoffLine stray = line(1, {onFault(0, 0), onFault(1000, 0)});
  stray.fault = 1;
  EXPECT_THROW(readThrows({stray}, fault()), InvalidInputError);
}

} // namespace
} // namespace graben
