#include "graben/core/dip.h"

#include "graben/core/errors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace graben {
namespace {

const double kHalfRoot3 = std::sqrt(3.0) / 2.0;

void expectNear(const Vector3& value, const Vector3& expected) {
  EXPECT_LT((value - expected).norm(), 1e-15) << value.transpose() << " instead of " << expected.transpose();
}

TEST(Dip, NormalLeansTowardsTheDipDirection) {
  expectNear(normalOf(DipAzimuth{30.0, 0.0}), {0.0, 0.5, kHalfRoot3});
  expectNear(normalOf(DipAzimuth{30.0, 90.0}), {0.5, 0.0, kHalfRoot3});
  expectNear(normalOf(DipAzimuth{30.0, 180.0}), {0.0, -0.5, kHalfRoot3});
  expectNear(normalOf(DipAzimuth{60.0, -90.0}), {-kHalfRoot3, 0.0, 0.5});
  EXPECT_EQ(normalOf(DipAzimuth{0.0, 77.0}), Vector3(0, 0, 1));
  EXPECT_EQ(normalOf(DipAzimuth{90.0, 360.0}), Vector3(0, 1, 0));
}

TEST(Dip, AlongTheStrikeTheBedDipsToTheRight) {
  expectNear(normalOf(StrikeDip{0.0, 30.0}), {0.5, 0.0, kHalfRoot3});
  expectNear(normalOf(StrikeDip{270.0, 30.0}), {0.0, 0.5, kHalfRoot3});
  EXPECT_EQ(dipAzimuthOf(StrikeDip{300.0, 12.0}).azimuth, 30.0);
  EXPECT_EQ(strikeDipOf(DipAzimuth{12.0, 30.0}).strike, 300.0);
}

TEST(Dip, ThereAndBack) {
  for (double dip = 0.5; dip <= 90.0; dip += 8.95)
    for (double azimuth = -180.0; azimuth <= 360.0; azimuth += 22.5) {
      const Vector3 normal = normalOf(DipAzimuth{dip, azimuth});
      EXPECT_NEAR(normal.norm(), 1.0, 1e-15);
      const DipAzimuth back = dipAzimuthOf(normal);
      EXPECT_NEAR(back.dip, dip, 1e-12);
      EXPECT_NEAR(std::remainder(back.azimuth - azimuth, 360.0), 0.0, 1e-11);
      EXPECT_GE(back.azimuth, 0.0);
      EXPECT_LT(back.azimuth, 360.0);
      const StrikeDip strike = strikeDipOf(normal);
      EXPECT_NEAR(std::remainder(strike.strike + 90.0 - azimuth, 360.0), 0.0, 1e-11);
      expectNear(normalOf(strike), normal);
    }
}

TEST(Dip, TakesNormalsOfAnyLengthAndSense) {
  EXPECT_NEAR(dipAzimuthOf(Vector3(-3e200, 0, -4e200)).dip, std::atan2(3, 4) * 45.0 / std::atan(1.0), 1e-12);
  EXPECT_EQ(dipAzimuthOf(Vector3(-3e200, 0, -4e200)).azimuth, 90.0);
  EXPECT_EQ(dipAzimuthOf(Vector3(0, 0, -2)).dip, 0.0);
  EXPECT_EQ(dipAzimuthOf(Vector3(0, 0, -2)).azimuth, 0.0);
}

TEST(Dip, RefusesWhatIsNoAttitude) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(normalOf(DipAzimuth{90.5, 0.0}), InvalidInputError);
  EXPECT_THROW(normalOf(DipAzimuth{-1.0, 0.0}), InvalidInputError);
  EXPECT_THROW(normalOf(DipAzimuth{nan, 0.0}), InvalidInputError);
  EXPECT_THROW(normalOf(DipAzimuth{10.0, 361.0}), InvalidInputError);
  EXPECT_THROW(normalOf(StrikeDip{-181.0, 10.0}), InvalidInputError);
  EXPECT_THROW(dipAzimuthOf(Vector3(0, 0, 0)), InvalidInputError);
  EXPECT_THROW(strikeDipOf(Vector3(nan, 0, 1)), InvalidInputError);
}

} // namespace
} // namespace graben
