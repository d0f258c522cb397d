#include "graben/faults/fault_boxes.h"

#include "graben/faults/fault_network.h"
#include "graben/faults/fault_signature.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

using namespace graben;
using test::Random;

namespace {

std::vector<Bounds> someBoxes(std::size_t count) {
  Random random(3);
  std::vector<Bounds> boxes;
  for (std::size_t i = 0; i < count; ++i) {
    Bounds box;
    const Vector3 at = random.point(1000.0);
    box.extend(at);
    box.extend(at + random.point(80.0));
    boxes.push_back(box);
  }
  return boxes;
}

FaultNetwork manyFaults() {
  Random random(5);
  std::vector<FaultSurface> faults;
  for (int i = 0; i < 70; ++i)
    faults.push_back(test::plane("f", random.point(1000.0), {0.0, random.in(100.0, 900.0), 0.0}, {random.in(20.0, 90.0), 0.0, 200.0}));
  return FaultNetwork(std::move(faults));
}

} // namespace

TEST(FaultBoxes, FindTheSameAsALookAtAll) {
  for (const std::size_t count : {0UL, 1UL, 4UL, 5UL, 300UL}) {
    const std::vector<Bounds> boxes = someBoxes(count);
    const FaultBoxes tree(boxes);
    Random random(7);
    std::vector<std::size_t> found;
    for (int i = 0; i < 200; ++i) {
      Bounds box;
      box.extend(random.point(1000.0));
      box.extend(box.low + random.point(150.0));
      std::vector<std::size_t> expected;
      for (std::size_t k = 0; k < count; ++k)
        if (boxes[k].overlaps(box))
          expected.push_back(k);
      tree.gather(box, found);
      EXPECT_EQ(found, expected);
      const double reach = random.in(0.0, 400.0);
      std::set<std::size_t> near;
      tree.forEachWithin(box.low, [reach] { return reach; }, [&near](std::size_t k) { near.insert(k); });
      for (std::size_t k = 0; k < count; ++k)
        EXPECT_EQ(near.count(k) == 1, (box.low - box.low.cwiseMax(boxes[k].low).cwiseMin(boxes[k].high)).norm() <= reach);
    }
  }
}

TEST(FaultBoxes, ANetworkAnswersAsItsFaultsDo) {
  const FaultNetwork network = manyFaults();
  Random random(11);
  for (int i = 0; i < 300; ++i) {
    const Vector3 a = random.point(1100.0);
    const Vector3 b = a + random.point(600.0);
    bool crosses = false;
    std::uint64_t signature = 0;
    FaultPoint nearest;
    std::optional<FaultCrossing> first;
    for (std::size_t f = 0; f < network.size(); ++f) {
      const auto crossings = network.crossings(f, a, b);
      crosses = crosses || !crossings.empty();
      if (crossings.size() % 2 == 1)
        signature ^= signatureOf(f);
      if (!crossings.empty() && (!first || crossings[0].parameter < first->parameter))
        first = crossings[0];
      const FaultPoint point = network.nearest(f, a);
      if (nearest.fault < 0 || point.distance < nearest.distance)
        nearest = point;
    }
    EXPECT_EQ(network.crosses(a, b), crosses);
    EXPECT_EQ(faultSignature(network, a, b), signature);
    EXPECT_EQ(network.nearest(a).fault, nearest.fault);
    EXPECT_EQ(network.nearest(a).point, nearest.point);
    const auto found = network.firstCrossing(a, b);
    ASSERT_EQ(found.has_value(), first.has_value());
    if (first) {
      EXPECT_EQ(found->fault, first->fault);
    }
    EXPECT_TRUE(!crosses || network.mayPart({a, b}));
  }
}
