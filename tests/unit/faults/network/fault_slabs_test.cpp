#include "graben/faults/fault_slabs.h"

#include "shapes.h"

#include <gtest/gtest.h>

using namespace graben;
using test::Random;

namespace {

/// Bent faults that cross, of triangles larger and smaller than the boxes looked at.
FaultNetwork bentFaults(std::size_t count) {
  std::vector<FaultSurface> faults;
  for (std::size_t f = 0; f < count; ++f) {
    const double at = 5.0 * static_cast<double>(f);
    const int cells = f % 2 == 0 ? 4 : 40;
    faults.push_back(FaultSurface::fromMesh("bent", test::sheet(cells, cells, [&](double u, double v) {
      return Vector3(at + 10.0 * std::sin(2.0 * u) + 20.0 * v * (f % 2 == 0 ? 1.0 : -1.0), 100.0 * u - 50.0, 100.0 * v - 50.0);
    })));
  }
  return FaultNetwork(std::move(faults));
}

Vector3 pointIn(const Bounds& box, Random& random) {
  const Vector3 p = random.point(1.0);
  return 0.5 * (box.low + box.high) + 0.5 * (box.high - box.low).cwiseProduct(p);
}

TEST(FaultSlabs, NoFaultLiesBetweenPlacesToldClear) {
  const FaultNetwork faults = bentFaults(3);
  Random random(4);
  FaultSlabs slabs;
  std::size_t clear = 0, crossing = 0, opposite = 0;
  for (int n = 0; n < 500; ++n) {
    const Vector3 centre = random.point(60.0);
    const Vector3 half = Vector3::Constant(random.in(0.1, 15.0));
    const Bounds box{centre - half, centre + half};
    slabs.gather(faults, box);
    EXPECT_TRUE(!slabs.empty() || !faults.mayTouch(box));
    for (int pair = 0; pair < 50; ++pair) {
      const Vector3 a = pointIn(box, random), b = pointIn(box, random);
      const FaultSlabs::Mark from = slabs.mark(a), to = slabs.mark(b);
      const bool crosses = faults.crosses(a, b);
      crossing += crosses ? 1 : 0;
      opposite += crosses && FaultSlabs::opposite(from, to) ? 1 : 0;
      clear += !slabs.empty() && slabs.clear(from & to) ? 1 : 0;
      ASSERT_FALSE(crosses && slabs.clear(from & to)) << a.transpose() << " to " << b.transpose();
    }
  }
  EXPECT_GT(clear, 3000U);
  EXPECT_GT(crossing, 1000U);
  EXPECT_GT(opposite, crossing / 3);
}

TEST(FaultSlabs, NothingIsClearAmongMoreFaultsThanAMarkHolds) {
  const FaultNetwork faults = bentFaults(17);
  FaultSlabs slabs;
  slabs.gather(faults, faults.bounds());
  const FaultSlabs::Mark outside = slabs.mark(Vector3(1e4, 0.0, 0.0));
  EXPECT_FALSE(slabs.clear(outside));
}

TEST(FaultSlabs, EmptyWhereThereIsNoFault) {
  FaultSlabs slabs;
  slabs.gather(FaultNetwork(), {Vector3::Zero(), Vector3::Ones()});
  EXPECT_TRUE(slabs.empty());
  slabs.gather(bentFaults(1), {Vector3::Constant(1e3), Vector3::Constant(2e3)});
  EXPECT_TRUE(slabs.empty());
  EXPECT_TRUE(slabs.clear(slabs.mark(Vector3::Constant(1.5e3))));
}

} // namespace
