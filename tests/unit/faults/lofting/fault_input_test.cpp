#include "graben/faults/fault_input.h"
#include "graben/faults/out_of_reach.h"

#include <gmock/gmock.h>

namespace graben {
namespace {

FaultInput wall() {
  TriangleMesh mesh;
  mesh.vertices = {{0, -30, 900}, {0, 30, 900}, {0, 30, 1100}, {0, -30, 1100}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return {"wall", std::move(mesh)};
}

Bounds boxOf(const FaultInput& fault, const LocalFrame& frame) { return boundsOf(faultSurfaces(fault, frame).faults.at(0).mesh.vertices); }

TEST(FaultInput, IsBroughtIntoTheFrame) {
  LocalFrame frame;
  frame.origin = {10.0, 20.0, 1000.0};
  frame.z_scale = 2.0;
  const Bounds box = boxOf(wall(), frame);
  EXPECT_TRUE(box.low.isApprox(Vector3(-10, -50, -200))) << box.low.transpose();
  EXPECT_TRUE(box.high.isApprox(Vector3(-10, 10, 200))) << box.high.transpose();
}

TEST(FaultInput, IsTurnedOverWhereItsZGrowsTheOtherWay) {
  FaultInput fault = wall();
  EXPECT_EQ(boxOf(fault, {}).low.z(), 900.0) << "no word on it: as the frame";
  fault.z_positive = ZPositive::Down;
  EXPECT_EQ(boxOf(fault, {}).low.z(), -1100.0);
  LocalFrame down;
  down.z_positive = ZPositive::Down;
  EXPECT_EQ(boxOf(fault, down).low.z(), -1100.0) << "both down: the frame turns it";
}

TEST(FaultsOutOfReach, SayHowFarAwayTheyAre) {
  const FaultNetwork faults(faultSurfaces(wall()).faults);
  Bounds data;
  data.extend({5.0, 0.0, 950.0});
  data.extend({8.0, 1.0, 1000.0});
  EXPECT_EQ(faultsOutOfReach(faults, data, 5.5, "points"), "");
  EXPECT_THAT(faultsOutOfReach(faults, data, 4.5, "points"), testing::HasSubstr("points, so none has an effect; they lie 5 away"));
  EXPECT_EQ(faultsOutOfReach(FaultNetwork(), data, 4.5, "points"), "") << "no faults";
  EXPECT_EQ(faultsOutOfReach(faults, Bounds(), 4.5, "points"), "") << "no data";
}

} // namespace
} // namespace graben
