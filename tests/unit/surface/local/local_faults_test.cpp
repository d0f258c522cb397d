#include "local/local_faults.h"

#include "local/box_around.h"
#include "graben/faults/fault_signature.h"
#include "unit/faults/shapes.h"

#include <gtest/gtest.h>

namespace graben {
namespace {

/// A bent fault that a second one branches from.
FaultNetwork bentAndBranch() {
  FaultSurface bent = FaultSurface::fromMesh("bent", test::sheet(20, 10, [](double u, double v) {
                                               return Vector3(100.0 * u - 50.0, 8.0 * std::sin(5.0 * u) + 20.0 * v, 60.0 * v - 30.0);
                                             }));
  FaultSurface branch = test::plane("branch", {0.0, 10.0, -30.0}, {5.0, 40.0, 0.0}, {10.0, 0.0, 60.0});
  return FaultNetwork({bent, branch}, 12.0);
}

TEST(LocalFaults, AnswersAsTheNetworkDoes) {
  const FaultNetwork faults = bentAndBranch();
  ASSERT_EQ(faults.branches().size(), 1U);
  const FaultBorders borders(faults);
  test::Random random(3);
  int hidden = 0;
  for (int i = 0; i < 400; ++i) {
    const Vector3 centre = 1.3 * random.point(40.0);
    const double half = random.in(2.0, 25.0);
    const LocalFaults local(faults, borders, boxAround(centre, half));
    for (int j = 0; j < 60; ++j) {
      const Vector3 a = centre + random.point(half);
      const Vector3 b = centre + random.point(half);
      ASSERT_EQ(local.sameSide(a, b), sameSide(faults, a, b)) << a.transpose() << " / " << b.transpose();
      ASSERT_EQ(local.signature(a, b), faultSignature(faults, a, b)) << a.transpose() << " / " << b.transpose();
      ASSERT_EQ(local.crosses(a, b), faults.crosses(a, b)) << a.transpose() << " / " << b.transpose();
      if (local.sides(a) != LocalFaults::kUncertain && local.sides(b) != LocalFaults::kUncertain) {
        ASSERT_EQ(local.sides(a) == local.sides(b), sameSide(faults, a, b)) << a.transpose() << " / " << b.transpose();
      }
      hidden += sameSide(faults, a, b) ? 0 : 1;
    }
  }
  EXPECT_GT(hidden, 1000);
}

TEST(LocalFaults, AFaultThatCutsOffACornerOfTheBoxCounts) {
  const FaultNetwork faults = bentAndBranch();
  const FaultBorders borders(faults);
  test::Random random(4);
  int hidden = 0;
  for (int i = 0; i < 2000; ++i) {
    const double u = random.in(0.1, 0.9), v = random.in(0.1, 0.9);
    const Vector3 on_fault(100.0 * u - 50.0, 8.0 * std::sin(5.0 * u) + 20.0 * v, 60.0 * v - 30.0);
    const double half = random.in(2.0, 10.0);
    Vector3 to_corner;
    for (int axis = 0; axis < 3; ++axis)
      to_corner[axis] = random.in(-1.0, 1.0) < 0.0 ? -half : half;
    const Vector3 centre = on_fault - random.in(0.97, 1.0) * to_corner;
    const LocalFaults local(faults, borders, boxAround(centre, half));
    const Vector3 corner = centre + 0.9999 * to_corner;
    ASSERT_EQ(local.sameSide(corner, centre), sameSide(faults, corner, centre)) << i;
    ASSERT_EQ(local.signature(centre, corner), faultSignature(faults, centre, corner)) << i;
    hidden += sameSide(faults, corner, centre) ? 0 : 1;
  }
  EXPECT_GT(hidden, 300);
}

TEST(LocalFaults, OutsideTheBoxAllFaultsCount) {
  const FaultNetwork faults = bentAndBranch();
  const LocalFaults local(faults, FaultBorders(faults), boxAround({30.0, 0.0, 0.0}, 15.0));
  ASSERT_FALSE(local.empty());
  EXPECT_EQ(local.sides({-30.0, 0.0, 0.0}), LocalFaults::kUncertain);
  EXPECT_FALSE(local.sameSide({-30.0, -40.0, 0.0}, {-30.0, 40.0, 0.0}));
}

} // namespace
} // namespace graben
