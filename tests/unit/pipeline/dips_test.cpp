#include "unit/pipeline/small_model.h"

#include <gmock/gmock.h>

#include <cmath>

namespace graben {
namespace {

using testing::HasSubstr;

constexpr double kStep = 100.0;
constexpr double kHeight = 8.0;

/// Waves whose every pick lies at height 0: only their dips tell that they are there.
double height(double x) { return kHeight * std::sin(M_PI * x / kStep); }

Vector3 normal(double x) {
  const double slope = kHeight * M_PI / kStep * std::cos(M_PI * x / kStep);
  return Vector3(-slope, 0.0, 1.0).normalized();
}

struct Waves {
  Points picks;
  std::vector<DipMeasurement> dips;
};

Waves waves() {
  Waves w;
  for (int i = 0; i <= 12; ++i)
    for (int j = 0; j <= 24; ++j) {
      w.picks.emplace_back(kStep * i, 0.5 * kStep * j, 0.0);
      w.dips.push_back({w.picks.back(), normal(kStep * i)});
    }
  return w;
}

ReconstructionOptions options() {
  ReconstructionOptions o;
  o.threads = 1;
  o.voxel_size = 20.0;
  return o;
}

double rms(const TriangleMesh& mesh, double z_factor = 1.0) {
  double sum = 0.0;
  std::size_t count = 0;
  for (const Vector3& p : mesh.vertices)
    if (p.x() > kStep && p.x() < 11 * kStep && p.y() > kStep && p.y() < 11 * kStep) {
      sum += std::pow(p.z() * z_factor - height(p.x()), 2);
      ++count;
    }
  EXPECT_GT(count, 1000U);
  return std::sqrt(sum / static_cast<double>(count));
}

TEST(Dips, MakeTheShapeBetweenThePicks) {
  const Waves w = waves();
  const ReconstructionResult without = HorizonReconstruction(options()).reconstruct(w.picks);
  const ReconstructionResult with = HorizonReconstruction(options()).reconstruct(w.picks, std::vector<FaultInput>(), w.dips);
  EXPECT_NEAR(rms(without.mesh), kHeight / std::sqrt(2.0), 0.1) << "flat";
  EXPECT_LT(rms(with.mesh), 0.3 * rms(without.mesh)) << "of waves with one measurement for each half wave";
  EXPECT_EQ(with.report.measurements, w.dips.size());
  EXPECT_EQ(with.report.measurements_not_usable, 0U);
  EXPECT_EQ(with.report.picks, w.picks.size());
  EXPECT_TRUE(with.report.warnings.empty());
}

/// z positive down and in other units than x and y: places turn with the picks, angles are of the ground.
TEST(Dips, MeanTheSameInDepthAndInTime) {
  Waves w = waves();
  const ReconstructionResult up = HorizonReconstruction(options()).reconstruct(w.picks, std::vector<FaultInput>(), w.dips);
  ReconstructionOptions o = options();
  o.z_positive = ZPositive::Down;
  o.z_scale = 2.0;
  for (Vector3& p : w.picks)
    p.z() /= -2.0;
  for (DipMeasurement& dip : w.dips)
    dip.place.z() /= -2.0;
  const ReconstructionResult down = HorizonReconstruction(o).reconstruct(w.picks, std::vector<FaultInput>(), w.dips);
  EXPECT_NEAR(rms(down.mesh, -2.0), rms(up.mesh), 0.05);
}

TEST(Dips, ThatCannotFitAreLeftOutWithAWarning) {
  Waves w = waves();
  const TriangleMesh expected = HorizonReconstruction(options()).reconstruct(w.picks, std::vector<FaultInput>(), w.dips).mesh;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  w.dips.push_back({Vector3(nan, 0, 0), Vector3::UnitZ()});
  w.dips.push_back({Vector3(500, 500, 0), Vector3(nan, 0, 1)});
  w.dips.push_back({Vector3(500, 500, 1000), Vector3::UnitZ()});
  const ReconstructionResult result = HorizonReconstruction(options()).reconstruct(w.picks, std::vector<FaultInput>(), w.dips);
  EXPECT_EQ(result.report.measurements_not_usable, 3U);
  ASSERT_EQ(result.report.warnings.size(), 2U) << testing::PrintToString(result.report.warnings);
  EXPECT_THAT(result.report.warnings[0], HasSubstr("2 of 328 dip measurements lie far from all picks or are not finite"));
  EXPECT_THAT(result.report.warnings[1], HasSubstr("1 of 328 dip measurements are farther than"));
  EXPECT_THAT(toJson(result.report), HasSubstr("\"not_usable\": 3"));
  EXPECT_NEAR(rms(result.mesh), rms(expected), 0.1);
}

TEST(Dips, OnTheWrongSideOfAFaultAreSetAside) {
  const SyntheticModel model = test::smallModel(SyntheticKind::Normal, 6000);
  std::vector<DipMeasurement> dips;
  for (const double x : {-30.0, 30.0}) // beside the fault, one block's height on the other's side
    for (const Vector3& p : model.picks().points)
      if (dips.size() < 40 && std::abs(model.faultOffset(0, p) - x) < 15.0)
        dips.push_back({{p.x() + (x < 0.0 ? 90.0 : -90.0), p.y(), p.z()}, Vector3::UnitZ()});
  ReconstructionOptions o;
  o.threads = 1;
  const ReconstructionResult result = HorizonReconstruction(o).reconstruct(model.picks().points, test::faultsOf(model), dips);
  EXPECT_GT(result.report.measurements_set_aside, 0U);
  EXPECT_EQ(result.pick_reason.size(), 6000U) << "of the picks alone";
  EXPECT_EQ(result.report.topology.components, 2U);
}

/// Whatever order the stages work in, results are told in the order of the input.
TEST(Picks, ComeBackInTheOrderOfTheInput) {
  SyntheticOptions s = SyntheticOptions::of(SyntheticKind::Normal);
  s.picks = 2000;
  s.smear = 100.0;
  const SyntheticModel model(s);
  ReconstructionOptions o;
  o.threads = 1;
  const Points picks = model.picks().points;
  const std::vector<DipMeasurement> dips = {{picks[7], Vector3::UnitZ()}};
  const ReconstructionResult result = HorizonReconstruction(o).reconstruct(picks, test::faultsOf(model), dips);
  ASSERT_EQ(result.picks.size(), picks.size());
  ASSERT_EQ(result.pick_normals.size(), picks.size());
  ASSERT_EQ(result.pick_piece.size(), picks.size());
  std::size_t aside = 0;
  for (std::size_t i = 0; i < picks.size(); ++i) {
    EXPECT_LT((result.picks[i] - picks[i]).norm(), 1e-6);
    aside += result.pick_reason[i] != PickReason::Good ? 1 : 0;
    EXPECT_TRUE(result.pick_reason[i] == PickReason::Good || std::abs(model.faultOffset(0, picks[i])) < 300.0) << "far from the fault";
  }
  EXPECT_GT(aside, 5U);
  o.keep_picks = false;
  EXPECT_TRUE(HorizonReconstruction(o).reconstruct(picks).pick_piece.empty());
}

} // namespace
} // namespace graben
