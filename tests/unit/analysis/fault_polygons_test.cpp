#include "graben/analysis/fault_polygons.h"

#include <gtest/gtest.h>

#include <cmath>

namespace graben {
namespace {

using Samples = std::vector<ThrowSample>;

ThrowSample sample(double along, const Vector3& footwall, const Vector3& hanging_wall, double heave) {
  ThrowSample s;
  s.along = along;
  s.footwall = footwall;
  s.hanging_wall = hanging_wall;
  s.heave = heave;
  s.throw_ = footwall.z() - hanging_wall.z();
  return s;
}

/// A fault along y at \a x whose heave at i is heave(i), towards +x.
template <typename Heave>
Samples alongY(double x, int count, Heave heave) {
  Samples samples;
  for (int i = 0; i < count; ++i)
    samples.push_back(sample(10.0 * i, {x, 10.0 * i, 5.0}, {x + heave(i), 10.0 * i, 5.0 - heave(i)}, heave(i)));
  return samples;
}

double signedArea(const Points& ring) {
  double sum = 0.0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vector3& p = ring[i];
    const Vector3& q = ring[(i + 1) % ring.size()];
    sum += 0.5 * (p.x() * q.y() - p.y() * q.x());
  }
  return sum;
}

bool inside(const Points& ring, double x, double y) {
  bool in = false;
  for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++)
    if ((ring[i].y() > y) != (ring[j].y() > y) &&
        x < ring[i].x() + (y - ring[i].y()) / (ring[j].y() - ring[i].y()) * (ring[j].x() - ring[i].x()))
      in = !in;
  return in;
}

TEST(FaultPolygons, LieBetweenTheCutoffsAndCloseAtTips) {
  const auto polygons = faultPolygons({alongY(1e6, 11, [](int i) { return 2.0 * std::min(i, 10 - i); })});
  ASSERT_EQ(polygons.size(), 1U);
  EXPECT_FALSE(polygons[0].overlap);
  EXPECT_NEAR(polygons[0].area, 500.0, 1e-6);
  EXPECT_NEAR(signedArea(polygons[0].ring), 500.0, 1e-3) << "counter-clockwise";
  EXPECT_EQ(polygons[0].ring.size(), 20U) << "each tip is one point";
  for (const Vector3& p : polygons[0].ring)
    EXPECT_NEAR(p.z(), 5.0 - (p.x() - 1e6), 1e-6);
}

TEST(FaultPolygons, TellOverlapFromGapWhereAFaultTurns) {
  const auto polygons = faultPolygons({alongY(0.0, 21, [](int i) { return 10.5 - i; })});
  ASSERT_EQ(polygons.size(), 2U);
  EXPECT_FALSE(polygons[0].overlap);
  EXPECT_TRUE(polygons[1].overlap);
  EXPECT_NEAR(polygons[0].area, 0.5 * 10.5 * 105.0, 1e-6);
  EXPECT_NEAR(polygons[1].area, 0.5 * 9.5 * 95.0, 1e-6);
}

TEST(FaultPolygons, OfTwoFaultsDoNotOverlap) {
  Samples branch; // along x, into the first fault's gap from x = 20 down to 3
  for (int i = 0; i < 8; ++i)
    branch.push_back(sample(3.0 * i, {24.0 - 3.0 * i, 50.0, 0.0}, {24.0 - 3.0 * i, 58.0, -8.0}, 8.0));
  const auto polygons = faultPolygons({alongY(0.0, 11, [](int) { return 10.0; }), branch});
  ASSERT_EQ(polygons.size(), 2U);
  EXPECT_NEAR(polygons[0].area, 1000.0, 1e-6);
  EXPECT_NEAR(polygons[1].area, 14.0 * 8.0, 1e-6) << "what is left of the branch beyond the first fault's gap";
  int both = 0;
  for (double x = 0.5; x < 30.0; x += 1.0)
    for (double y = 0.5; y < 100.0; y += 1.0)
      both += inside(polygons[0].ring, x, y) && inside(polygons[1].ring, x, y) ? 1 : 0;
  EXPECT_EQ(both, 0);
}

TEST(FaultPolygons, EndAtAGapBetweenSamplesAndLeaveOutWhatIsTooSmall) {
  Samples samples = alongY(0.0, 11, [](int) { return 4.0; });
  for (ThrowSample s : alongY(0.0, 3, [](int) { return 4.0; })) {
    s.along += 500.0;
    s.footwall.y() += 500.0;
    s.hanging_wall.y() += 500.0;
    samples.push_back(s);
  }
  EXPECT_EQ(faultPolygons({samples}).size(), 2U);
  FaultPolygonOptions options;
  options.least_area = 100.0;
  EXPECT_EQ(faultPolygons({samples}, options).size(), 1U);
  EXPECT_TRUE(faultPolygons({{}, {samples[0]}}).empty());
}

/// Cutoffs that wind so much that the line along one and back along the other crosses itself.
TEST(FaultPolygons, OfWindingCutoffsAreValidRings) {
  Samples samples;
  for (int i = 0; i <= 40; ++i) {
    const Vector3 f(6.0 * std::sin(0.9 * i), 4.0 * i, 0.0);
    samples.push_back(sample(4.0 * i, f, f + Vector3(3.0, 3.0 * std::cos(1.7 * i), -2.0), 3.0));
  }
  const auto polygons = faultPolygons({samples});
  ASSERT_GE(polygons.size(), 1U);
  for (const FaultPolygon& polygon : polygons) {
    EXPECT_NEAR(signedArea(polygon.ring), polygon.area, 1e-6);
    EXPECT_GT(polygon.area, 0.0);
  }
}

} // namespace
} // namespace graben
