#include "fit/surface_patches.h"
#include "shapes.h"
#include "local/way_to_surface.h"

#include "graben/surface/local_fit.h"

#include <gtest/gtest.h>

namespace graben::detail {
namespace {

constexpr double kReach = 3.0;

LocalSurface bentSurface(test::Random& random, double bend) {
  LocalSurface surface = frameAt(Vector3(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)),
                                 Vector3(random.normal(0.6), random.normal(0.6), 1.0).normalized());
  surface.radius = 4.0;
  surface.valid = true;
  for (std::size_t k = 0; k < surface.coefficients.size(); ++k)
    surface.coefficients[k] = random.normal(k < 3 ? 1.0 : bend);
  return surface;
}

TEST(PatchLanes, FeetAreThoseOfTheSurfacesOneByOne) {
  test::Random random(5);
  int reached = 0, away = 0, missed = 0;
  for (int round = 0; round < 300; ++round) {
    PatchLanes lanes{};
    std::array<LocalSurface, kLanes> surfaces;
    Points centres;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      surfaces[lane] = bentSurface(random, round % 2 == 0 ? 1e-5 : 0.5);
      centres.push_back(Vector3(random.uniform(-3.0, 3.0), random.uniform(-3.0, 3.0), 0.0));
      setLane(surfaces[lane], centres[lane], kReach, lane, lanes);
    }
    const Vector3 place(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
    const Vector3 direction = Vector3(random.normal(0.7), random.normal(0.7), 1.0).normalized();
    PatchFeet feet{};
    const bool any = findFeet(lanes, place.data(), direction.data(), 0.34, feet);
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const LocalSurface& surface = surfaces[lane];
      const LocalEstimate expected = surface.from(place, direction);
      const double share = (place - centres[lane]).squaredNorm() / (kReach * kReach);
      if (share >= 1.0 || surface.normal.dot(direction) < 0.34 || !expected.valid) {
        EXPECT_EQ(feet.weight[lane], 0.0);
        ++(share >= 1.0 ? away : missed);
        continue;
      }
      ASSERT_TRUE(any);
      ++reached;
      EXPECT_NEAR(feet.weight[lane], (1.0 - share) * (1.0 - share), 1e-12);
      EXPECT_NEAR(feet.offset[lane], expected.offset, 1e-9 * (1.0 + std::abs(expected.offset)));
      const Vector3 normal = Vector3(feet.normal[0][lane], feet.normal[1][lane], feet.normal[2][lane]).normalized();
      EXPECT_LT((normal * (normal.dot(direction) < 0.0 ? -1.0 : 1.0) - expected.normal).norm(), 1e-9);
    }
  }
  EXPECT_GT(reached, 200);
  EXPECT_GT(away, 100);
  EXPECT_GT(missed, 20);
}

TEST(PatchLanes, NoneReachesAPlaceFarAway) {
  test::Random random(6);
  PatchLanes lanes{};
  for (std::size_t lane = 0; lane < kLanes; ++lane)
    setLane(bentSurface(random, 0.1), Vector3::Zero(), kReach, lane, lanes);
  const Vector3 up = Vector3::UnitZ();
  PatchFeet feet{};
  EXPECT_FALSE(findFeet(lanes, Vector3(0.0, kReach, 0.1).eval().data(), up.data(), -1.0, feet));
  EXPECT_TRUE(findFeet(lanes, Vector3(0.0, 0.5 * kReach, 0.1).eval().data(), up.data(), -1.0, feet));
}

} // namespace
} // namespace graben::detail
