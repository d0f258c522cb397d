#include "unit/pipeline/small_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace graben {
namespace {

using Profile = std::map<double, double>; ///< z by place along strike

double at(const Profile& profile, double s) {
  const auto after = profile.lower_bound(s);
  if (after == profile.begin() || after == profile.end())
    return std::numeric_limits<double>::quiet_NaN();
  const auto before = std::prev(after);
  return before->second + (s - before->first) / (after->first - before->first) * (after->second - before->second);
}

/// The true throw of a planar fault, from its exact cutoff lines.
class TrueThrow {
public:
  explicit TrueThrow(const SyntheticModel& model) {
    const TriangleMesh fault = model.faultMesh(0);
    const auto corner = [&](int i) { return fault.vertices[static_cast<std::size_t>(fault.triangles[0][static_cast<std::size_t>(i)])]; };
    const Vector3 a = corner(1) - corner(0);
    const Vector3 b = corner(2) - corner(0);
    strike_ = Vector3(a.x() * b.z() - a.z() * b.x(), a.y() * b.z() - a.z() * b.y(), 0.0).normalized();
    for (const TrueCutoffLine& line : model.cutoffLines())
      for (const Vector3& p : line.points)
        (line.side < 0 ? footwall_ : hanging_wall_)[along(p)] = p.z();
  }
  double along(const Vector3& p) const { return p.dot(strike_); }
  /// NaN beyond the ends of the true lines.
  double operator()(double s) const { return at(footwall_, s) - at(hanging_wall_, s); }

private:
  Vector3 strike_;
  Profile footwall_, hanging_wall_;
};

struct ThrowErrors {
  double rms = 0.0;
  double largest = 0.0;
  std::size_t compared = 0;
};

ThrowErrors errors(const TrueThrow& truth, const std::vector<ThrowSample>& samples) {
  ThrowErrors e;
  for (const ThrowSample& s : samples) {
    const double expected = truth(truth.along(s.footwall));
    if (!std::isfinite(expected))
      continue;
    ++e.compared;
    e.rms += (s.throw_ - expected) * (s.throw_ - expected);
    e.largest = std::max(e.largest, std::abs(s.throw_ - expected));
  }
  e.rms = std::sqrt(e.rms / static_cast<double>(std::max<std::size_t>(e.compared, 1)));
  return e;
}

ReconstructionResult reconstruct(const SyntheticModel& model, double z_scale = 1.0) {
  ReconstructionOptions o;
  o.threads = 1;
  o.z_positive = model.options().frame.z_positive;
  o.z_scale = z_scale;
  return HorizonReconstruction(o).reconstruct(model.picks().points, test::faultsOf(model));
}

/// Both cutoff lines err by about half a sigma each; 20,000 picks are 42 m apart.
TEST(Throw, ReadOffTheSurfaceIsTheTrueOne) {
  for (const SyntheticKind kind : {SyntheticKind::Normal, SyntheticKind::Reverse}) {
    const SyntheticModel model = test::smallModel(kind, 20000);
    const double sigma = model.options().noise;
    const ReconstructionResult result = reconstruct(model);
    ASSERT_EQ(result.throws.size(), 1U);
    const ThrowErrors e = errors(TrueThrow(model), result.throws[0]);
    EXPECT_GT(e.compared, 140U);
    EXPECT_LT(e.rms, 1.0 * sigma);
    EXPECT_LT(e.largest, 4.0 * sigma);
    const ThrowSummary& summary = result.report.faults[0].throw_;
    const double sign = kind == SyntheticKind::Reverse ? -1.0 : 1.0;
    EXPECT_NEAR(sign * summary.max, 98.0, 4.0);
    EXPECT_GT(sign * summary.mean_heave, 40.0) << "of 60 degrees";
    EXPECT_GT(summary.length, 5500.0);
  }
}

TEST(Throw, FallsToZeroAtATip) {
  const SyntheticModel model = test::smallModel(SyntheticKind::Tip, 20000);
  const ReconstructionResult result = reconstruct(model);
  ASSERT_EQ(result.throws.size(), 1U);
  const std::vector<ThrowSample>& samples = result.throws[0];
  ASSERT_GT(samples.size(), 50U);
  EXPECT_LT(std::min(std::abs(samples.front().throw_), std::abs(samples.back().throw_)), 1e-6);
  EXPECT_LT(errors(TrueThrow(model), samples).rms, 2.0 * model.options().noise);
}

/// Throws are in the units of z, and positive where the hanging wall is down, whichever way z grows.
TEST(Throw, MeansTheSameInTimePositiveDown) {
  SyntheticOptions o = SyntheticOptions::of(SyntheticKind::Normal);
  o.picks = 5000;
  const ReconstructionResult up = reconstruct(SyntheticModel(o));
  o.frame.z_scale = 1.5;
  o.frame.z_positive = ZPositive::Down;
  const ReconstructionResult down = reconstruct(SyntheticModel(o), 1.5);
  EXPECT_NEAR(down.report.faults[0].throw_.mean, up.report.faults[0].throw_.mean / 1.5, 0.1);
  EXPECT_NEAR(down.report.faults[0].throw_.mean_heave, up.report.faults[0].throw_.mean_heave, 0.1);
  const ThrowSample& s = down.throws[0][down.throws[0].size() / 2];
  EXPECT_NEAR(s.hanging_wall.z() - s.footwall.z(), s.throw_, 1e-9);
}

} // namespace
} // namespace graben
