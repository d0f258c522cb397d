#include "graben/analysis/fault_profile.h"

#include "graben/core/errors.h"

#include <gtest/gtest.h>

#include <cmath>

namespace graben {
namespace {

/// A plane that dips 60 degrees towards +x (azimuth 90) and passes through x = 0 at z = 0.
FaultNetwork fault() {
  const double run = 1.0 / std::tan(M_PI / 3.0);
  TriangleMesh mesh;
  mesh.vertices = {{-500.0 * run, -100.0, 500.0}, {500.0 * run, -100.0, -500.0}, {500.0 * run, 1100.0, -500.0}, {-500.0 * run, 1100.0, 500.0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return FaultNetwork({FaultSurface::fromMesh("f", mesh)});
}

/// A throw of \a throw_ at a distance along strike.
ThrowSample sample(double along, double throw_) {
  ThrowSample s;
  s.along = along;
  s.footwall = {0.0, along, 0.0};
  s.throw_ = throw_;
  s.heave = throw_ / std::tan(M_PI / 3.0);
  s.hanging_wall = {s.heave, along, -throw_};
  s.dip_slip = std::hypot(s.throw_, s.heave);
  return s;
}

TEST(FaultProfile, HasARowEverySoOftenBetweenTheSamples) {
  std::vector<ThrowSample> samples;
  for (int i = 0; i <= 40; ++i)
    samples.push_back(sample(26.0 * i, 10.0 + 2.6 * i)); // 0.1 a metre
  const FaultProfile profile = faultProfile(samples, 0, fault(), 100.0);
  ASSERT_EQ(profile.rows.size(), 11U);
  for (std::size_t k = 0; k < profile.rows.size(); ++k) {
    const ProfileRow& row = profile.rows[k];
    EXPECT_DOUBLE_EQ(row.along, 100.0 * static_cast<double>(k));
    EXPECT_NEAR(row.throw_, 10.0 + 10.0 * static_cast<double>(k), 1e-9);
    EXPECT_NEAR(row.footwall.z() - row.hanging_wall.z(), row.throw_, 1e-9);
    EXPECT_NEAR(row.dip, 60.0, 1e-6);
    EXPECT_NEAR(row.azimuth, 90.0, 1e-6);
  }
  EXPECT_EQ(profile.largest, 10U);
  EXPECT_DOUBLE_EQ(profile.length, 1040.0);
  EXPECT_NEAR(profile.ratio, 110.0 / std::sin(M_PI / 3.0) / 1040.0, 1e-9);
  EXPECT_FALSE(profile.tip_at_start);
  EXPECT_FALSE(profile.tip_at_end);
}

TEST(FaultProfile, FindsTips) {
  std::vector<ThrowSample> samples;
  for (int i = 0; i <= 10; ++i)
    samples.push_back(sample(50.0 * i, -4.0 * i));
  const FaultProfile profile = faultProfile(samples, 0, fault(), 50.0);
  EXPECT_TRUE(profile.tip_at_start);
  EXPECT_FALSE(profile.tip_at_end);
  EXPECT_EQ(profile.largest, 10U) << "a reverse fault's largest throw is its most negative one";
}

TEST(FaultProfile, HasNoRowsWhereNoThrowWasRead) {
  std::vector<ThrowSample> samples;
  for (int i = 0; i <= 10; ++i)
    samples.push_back(sample(10.0 * i, 5.0));
  for (int i = 60; i <= 70; ++i)
    samples.push_back(sample(10.0 * i, 5.0));
  const FaultProfile profile = faultProfile(samples, 0, fault(), 10.0);
  EXPECT_EQ(profile.rows.size(), 22U);
  for (const ProfileRow& row : profile.rows)
    EXPECT_TRUE(row.along <= 100.0 || row.along >= 600.0) << row.along;
}

TEST(FaultProfile, OfNextToNothingIsEmpty) {
  EXPECT_TRUE(faultProfile({}, 0, fault(), 10.0).rows.empty());
  EXPECT_TRUE(faultProfile({sample(0.0, 1.0)}, 0, fault(), 10.0).rows.empty());
  EXPECT_EQ(faultProfile({sample(0.0, 1.0), sample(0.0, 1.0)}, 0, fault(), 10.0).rows.size(), 1U);
  for (const double wrong : {0.0, -1.0, std::nan(""), 1e-9})
    EXPECT_THROW(faultProfile({sample(0.0, 1.0), sample(10.0, 1.0)}, 0, fault(), wrong), InvalidInputError) << wrong;
}

} // namespace
} // namespace graben
