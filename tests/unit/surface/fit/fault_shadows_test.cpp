#include "shapes.h"

#include "graben/surface/fault_shadows.h"

#include <gtest/gtest.h>

#include <functional>

namespace graben {
namespace {

using Height = std::function<double(double, double)>;

double bent(double x, double y) { return 0.002 * x * x + 0.05 * x - 0.03 * y + 0.001 * x * y; }

FaultSurface wall(double from, double to) {
  TriangleMesh mesh;
  mesh.vertices = {{0, from, -60}, {0, to, -60}, {0, to, 60}, {0, from, 60}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return FaultSurface::fromMesh("wall", mesh);
}

/// Picks on a sheet with a step of 8 at x = 0, none nearer to it than the shadow on either side.
struct Shadowed {
  test::Oriented picks;
  TangentPlanes planes;
  NeighborGrid grid;
  FaultNetwork faults;

  Shadowed(double below, double above, FaultSurface fault, double noise = 0.0) : faults({std::move(fault)}) {
    const test::Oriented all = test::sheet(40.0, 0.8, bent);
    test::Random random(2);
    for (std::size_t i = 0; i < all.points.size(); ++i) {
      const Vector3& p = all.points[i];
      if (p.x() < 0.0 ? p.x() < -below : p.x() > above)
        picks.add(p + Vector3(0, 0, (p.x() > 0.0 ? 8.0 : 0.0) + random.normal(noise)), all.normals[i]);
    }
    planes = picks.planes();
    grid = NeighborGrid(picks.points);
  }

  FaultShadowFill fill(double limit = 0.0, unsigned threads = 0) const {
    FaultShadowOptions options;
    options.mean_distance = 0.8;
    options.limit = limit;
    options.threads = threads;
    return fillFaultShadows(LocalFit(grid, planes, faults, 100.0, 0.8), options);
  }
};

TEST(FaultShadows, PicksUpToTheFaultLeaveNone) {
  const FaultShadowFill fill = Shadowed(0.0, 0.0, wall(-60, 60)).fill();
  EXPECT_TRUE(fill.shadows.empty());
  EXPECT_TRUE(fill.places.empty());
}

TEST(FaultShadows, AreMeasuredOnEachSide) {
  const FaultShadowFill fill = Shadowed(5.0, 9.0, wall(-60, 60)).fill();
  ASSERT_EQ(fill.shadows.size(), 2U);
  for (const FaultShadow& shadow : fill.shadows) {
    const double expected = (shadow.side > 0) == (Shadowed(5.0, 9.0, wall(-60, 60)).faults.side(0, {1.0, 0.0, 0.0}) > 0) ? 9.0 : 5.0;
    EXPECT_NEAR(shadow.width, expected, 0.5);
    EXPECT_GT(shadow.share, 0.9);
    EXPECT_GT(shadow.carried, 100U);
  }
}

TEST(FaultShadows, TheSurfaceIsCarriedOnToTheFaultOnEachSide) {
  for (const double noise : {0.0, 0.1}) {
    const FaultShadowFill fill = Shadowed(5.0, 9.0, wall(-60, 60), noise).fill();
    double squares = 0.0, nearest = 1e9;
    for (std::size_t i = 0; i < fill.places.size(); ++i) {
      const Vector3& p = fill.places[i];
      squares += std::pow(p.z() - bent(p.x(), p.y()) - (p.x() > 0.0 ? 8.0 : 0.0), 2);
      nearest = std::min(nearest, std::abs(p.x()));
      ASSERT_LT(p.x() < 0.0 ? -p.x() : p.x(), 10.0);
      EXPECT_GT(fill.normals[i].z(), 0.9);
    }
    ASSERT_FALSE(fill.places.empty());
    EXPECT_LT(std::sqrt(squares / static_cast<double>(fill.places.size())), noise == 0.0 ? 0.02 : noise);
    EXPECT_LT(nearest, 0.8);
  }
}

TEST(FaultShadows, ThoseWiderThanTheLimitAreLeft) { EXPECT_TRUE(Shadowed(5.0, 9.0, wall(-60, 60)).fill(4.0).places.empty()); }

TEST(FaultShadows, ASideWithoutAnyPicksIsNoShadow) { EXPECT_TRUE(Shadowed(5.0, 1e9, wall(-60, 60)).fill().places.empty()); }

TEST(FaultShadows, BesideATipPlacesLeadToTheTip) {
  const FaultShadowFill fill = Shadowed(5.0, 5.0, wall(-60, 0)).fill();
  std::size_t beyond = 0;
  for (const Vector3& p : fill.places)
    beyond += p.y() > 0.5 ? 1 : 0;
  EXPECT_GT(beyond, 10U);
}

TEST(FaultShadows, AreTheSameForEveryNumberOfThreads) {
  const Shadowed shadowed(5.0, 9.0, wall(-60, 60), 0.1);
  EXPECT_EQ(shadowed.fill(0.0, 1).places, shadowed.fill(0.0, 3).places);
}

} // namespace
} // namespace graben
