// Picks and faults that cannot be of one frame are told before any work.
#include "graben/io/input_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace graben {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

PickSet picksAround(double z, double scale_xy = 1.0, double scale_z = 1.0) {
  PickSet picks;
  for (int i = 0; i < 40; ++i)
    for (int j = 0; j < 40; ++j)
      picks.points.emplace_back(scale_xy * (461000.0 + 75.0 * i), scale_xy * (5931000.0 + 75.0 * j), scale_z * (z + i + 2 * j));
  return picks;
}

/// A fault of 900 m height through the middle of the picks.
FaultInput fault(double z, double scale_xy = 1.0, double scale_z = 1.0, ZPositive way = ZPositive::Unknown) {
  std::vector<FaultStick> sticks;
  for (int s = 0; s < 5; ++s)
    sticks.push_back({{{scale_xy * 462400.0, scale_xy * (5931000.0 + 700.0 * s), scale_z * (z - 400.0)},
                       {scale_xy * 462800.0, scale_xy * (5931000.0 + 700.0 * s), scale_z * (z + 500.0)}}});
  FaultInput input;
  input.geometry = std::move(sticks);
  input.z_positive = way;
  return input;
}

std::string contradiction(PickSet picks, const FaultInput& f) {
  return checkInput(picks, {f}).contradiction;
}

TEST(InputCheck, WhatFitsIsLeftAlone) {
  PickSet picks = picksAround(-2000.0);
  const InputFindings found = checkInput(picks, {fault(-2000.0)});
  EXPECT_EQ(found.contradiction, "");
  EXPECT_THAT(found.warnings, IsEmpty());
  EXPECT_THAT(found.notes, Contains(HasSubstr("taken as elevation")));
  EXPECT_EQ(contradiction(picks, fault(-2700.0)), ""); // a blind fault, below
  EXPECT_EQ(contradiction(picks, fault(-5000.0)), ""); // far below, but in no other unit there
  EXPECT_EQ(checkInput(picks, {fault(-2000.0), fault(2000.0)}).contradiction, "");
}

TEST(InputCheck, OppositeSigns) {
  EXPECT_THAT(contradiction(picksAround(-2000.0), fault(2000.0)), HasSubstr("--fault-z-positive"));
  EXPECT_THAT(contradiction(picksAround(2000.0), fault(-2000.0)), HasSubstr("depth against elevation"));
  EXPECT_EQ(contradiction(picksAround(-2000.0), fault(2000.0, 1.0, 1.0, ZPositive::Down)), "");
}

TEST(InputCheck, FeetAndMetresSecondsAndMilliseconds) {
  EXPECT_THAT(contradiction(picksAround(-2000.0), fault(-2000.0, 1.0, 1.0 / 0.3048)), HasSubstr("be in feet and the picks' in metres"));
  EXPECT_THAT(contradiction(picksAround(-2000.0), fault(-2000.0, 1.0, 0.3048)), HasSubstr("be in metres and the picks' in feet"));
  EXPECT_THAT(contradiction(picksAround(2000.0), fault(2000.0, 1.0, 0.001)), HasSubstr("in seconds (or km)"));
  EXPECT_THAT(contradiction(picksAround(2000.0, 1.0, 0.001), fault(2000.0)), HasSubstr("in milliseconds (or m)"));
  EXPECT_THAT(contradiction(picksAround(-2000.0), fault(2000.0, 1.0, 1.0 / 0.3048)), HasSubstr("be in feet and grow the other way"));
  EXPECT_THAT(contradiction(picksAround(-2000.0), fault(-2000.0, 1.0 / 0.3048, 1.0)), HasSubstr("x and y of the faults seem to be in feet"));
  EXPECT_THAT(contradiction(picksAround(-2000.0), fault(-2000.0, 0.001, 1.0)), HasSubstr("in kilometres"));
}

TEST(InputCheck, AFaultFarAwayIsNotMadeToFit) {
  PickSet picks;
  for (int i = 0; i < 400; ++i)
    picks.points.emplace_back(10.0 * (i % 20), 10.0 * (i / 20), 0.1 * i);
  FaultInput far;
  far.geometry = std::vector<FaultStick>{{{{9000, 0, -50}, {9000, 0, 50}}}, {{{9000, 100, -50}, {9000, 100, 50}}}};
  EXPECT_EQ(contradiction(picks, far), "");
}

TEST(InputCheck, SinglePicksFarAwayAreNamed) {
  PickSet picks = picksAround(-2000.0);
  picks.points.emplace_back(1e9, 5931000.0, -2000.0);
  EXPECT_THAT(contradiction(picks, fault(-2000.0)), HasSubstr("one pick lies far from all others: (1000000000, 5931000, -2000)"));
  picks.points.back() = {461000.0, 5931000.0, 9.9e8};
  EXPECT_THAT(contradiction(picks, fault(-2000.0)), HasSubstr("990000000"));
  picks.points.back() = {461000.0 + 3e5, 5931000.0, -2000.0};
  EXPECT_EQ(contradiction(picks, fault(-2000.0)), "");
}

TEST(InputCheck, ExchangedCoordinates) {
  FaultInput turned = fault(-2000.0);
  for (FaultStick& stick : std::get<std::vector<FaultStick>>(turned.geometry))
    for (Vector3& p : stick.points)
      std::swap(p.x(), p.y());
  EXPECT_THAT(contradiction(picksAround(-2000.0), turned), HasSubstr("exchanged"));
}

TEST(InputCheck, PicksTakeTheWayOfFaultsWhereOnlyThatFits) {
  PickSet picks = picksAround(2000.0);
  const InputFindings found = checkInput(picks, {fault(2000.0, 1.0, 1.0, ZPositive::Down)});
  EXPECT_EQ(found.contradiction, "");
  EXPECT_EQ(picks.z_positive, ZPositive::Down);
  EXPECT_THAT(found.notes, Contains(HasSubstr("taken as depth")));
}

TEST(InputCheck, UnitsOfZ) {
  PickSet km = picksAround(-2000.0, 1.0, 0.001);
  EXPECT_THAT(checkInput(km, {fault(-2000.0, 1.0, 0.001)}).warnings, Contains(HasSubstr("--z-scale: 1000")));
  EXPECT_THAT(checkInput(km, {}).warnings, Contains(HasSubstr("--z-scale")));
  InputCheckOptions scaled;
  scaled.z_scale = 1000.0;
  EXPECT_THAT(checkInput(km, {}, scaled).warnings, IsEmpty());
  PickSet named = picksAround(-2000.0);
  named.z_unit = "ft";
  EXPECT_THAT(checkInput(named, {}).warnings, Contains(HasSubstr("0.3048")));
  named.z_unit = "ms";
  EXPECT_THAT(checkInput(named, {}).warnings, IsEmpty());
  PickSet flat;
  flat.points = {{0, 0, 5}, {1000, 0, 5}, {0, 1000, 5}};
  EXPECT_THAT(checkInput(flat, {}).warnings, IsEmpty());
}

TEST(InputCheck, Degrees) {
  PickSet degrees;
  for (int i = 0; i < 100; ++i)
    degrees.points.emplace_back(2.5 + 0.0003 * (i % 10), 53.5 + 0.0003 * (i / 10), -2000.0 - i);
  EXPECT_THAT(checkInput(degrees, {}).contradiction, HasSubstr("degrees"));
}

} // namespace
} // namespace graben
