#include "graben/core/local_frame.h"

#include "graben/core/errors.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <limits>

namespace graben {
namespace {

const double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(LocalFrame, OriginIsTheCentreInWholeUnits) {
  const LocalFrame frame =
      LocalFrame::around({{460000.4, 5930000, 1600}, {kNan, 0, 0}, {470000.9, 5940001, 1700}});
  EXPECT_EQ(frame.origin, Vector3(465001, 5935001, 1650));
}

TEST(LocalFrame, ThereAndBackToTheMillimetreAndBetter) {
  const Points picks{{460123.456, 5931234.567, 1623.891}, {469876.543, 5938765.432, 1711.007}};
  for (const ZPositive z : {ZPositive::Up, ZPositive::Down, ZPositive::Unknown}) {
    const LocalFrame frame = LocalFrame::around(picks, z, 1.37);
    for (const Vector3& p : picks)
      EXPECT_LT((frame.toUser(frame.toLocal(p)) - p).norm(), 2e-9);
  }
}

TEST(LocalFrame, DepthGrowsDownwardAndMirrors) {
  const LocalFrame frame =
      LocalFrame::around({{0, 0, 1000}, {100, 100, 1100}}, ZPositive::Down, 2.0);
  EXPECT_EQ(frame.toLocal({50, 50, 1060}), Vector3(0, 0, -20));
  EXPECT_TRUE(frame.mirrors());
  EXPECT_FALSE(LocalFrame::around({{0, 0, 0}}, ZPositive::Unknown).mirrors());
}

TEST(LocalFrame, NormalsStayPerpendicular) {
  const LocalFrame frame = LocalFrame::around({{0, 0, 0}, {100, 100, 50}}, ZPositive::Down, 2.5);
  const Vector3 u(3, 1, 0.7);
  const Vector3 v(-1, 2, 0.2);
  const Vector3 origin = frame.toLocal(Vector3::Zero());
  const Vector3 local = (frame.toLocal(u) - origin).cross(frame.toLocal(v) - origin).normalized();
  const Vector3 user = frame.normalToUser(local);
  EXPECT_NEAR(user.norm(), 1.0, 1e-12);
  EXPECT_NEAR(user.dot(u), 0.0, 1e-12);
  EXPECT_NEAR(user.dot(v), 0.0, 1e-12);
  EXPECT_LT((frame.normalToLocal(user) - local).norm(), 1e-12);
}

TEST(LocalFrame, SmallCloudsAreCentredToo) {
  const LocalFrame frame = LocalFrame::around({{5.001, 5.001, 5.001}, {5.002, 5.002, 5.002}});
  EXPECT_LT((frame.origin - Vector3::Constant(5.0015)).norm(), 0.001);
}

TEST(LocalFrame, RefusesNonsense) {
  EXPECT_THROW(LocalFrame::around({}), InvalidInputError);
  EXPECT_THROW(LocalFrame::around({{kNan, 0, 0}}), InvalidInputError);
  EXPECT_THROW(LocalFrame::around({{0, 0, 0}}, ZPositive::Up, 0.0), InvalidInputError);
  EXPECT_THROW(LocalFrame::around({{0, 0, 0}}, ZPositive::Up, kNan), InvalidInputError);
}

} // namespace
} // namespace graben
