#include "unit/pipeline/small_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace graben {
namespace {

/// A monocline or a step of \a throw_ at x = 0, and the sticks of a fault of 60 degrees there from one height to another.
struct StepModel {
  double throw_ = 0.0;

  double fold(double x) const { return -10.0 * (1.0 + std::tanh(x / 150.0)); }

  Points picks() const {
    std::mt19937_64 engine(1);
    const auto in = [&engine](double low, double high) { return low + (high - low) * static_cast<double>(engine() >> 11) * 0x1.0p-53; };
    Points picks;
    while (picks.size() < 4000) {
      const double x = in(-1000.0, 1000.0);
      const double y = in(-1000.0, 1000.0);
      const bool down = x > 0.0;
      const double z = fold(x) - (down ? throw_ : 0.0);
      if ((down && x < -z / std::sqrt(3.0)) || (!down && x > -z / std::sqrt(3.0)))
        continue;
      picks.emplace_back(x, y, z + in(-1.7, 1.7));
    }
    return picks;
  }

  static FaultInput fault(double top, double bottom) {
    std::vector<FaultStick> sticks;
    for (double y = -1200.0; y <= 1200.0; y += 300.0) {
      sticks.emplace_back();
      for (int k = 0; k <= 3; ++k) {
        const double z = top + (bottom - top) * k / 3.0;
        sticks.back().points.emplace_back(-z / std::sqrt(3.0), y, z);
      }
    }
    return {"f", sticks, ZPositive::Unknown};
  }
};

bool says(const std::vector<std::string>& sentences, const std::string& words) {
  return std::any_of(sentences.begin(), sentences.end(), [&](const std::string& s) { return s.find(words) != std::string::npos; });
}

ReconstructionOptions small() {
  ReconstructionOptions o;
  o.keep_picks = false;
  return o;
}

TEST(Faults, ABlindOneDoesNotCutAHorizonWithoutAStep) {
  const StepModel model;
  const ReconstructionResult whole = HorizonReconstruction(small()).reconstruct(model.picks(), {StepModel::fault(-110.0, -700.0)});
  EXPECT_EQ(whole.report.topology.components, 1U);
  EXPECT_EQ(whole.report.faults[0].cut_vertices, 0U);
  EXPECT_TRUE(says(whole.report.notes, "it was not extended"));
  ReconstructionOptions forced = small();
  forced.extend_faults = 250.0;
  const ReconstructionResult cut = HorizonReconstruction(forced).reconstruct(model.picks(), {StepModel::fault(-110.0, -700.0)});
  EXPECT_GT(cut.report.faults[0].cut_vertices, 0U);
}

TEST(Faults, OneThatStopsShortOfAStepIsExtendedAndThatIsSaid) {
  const StepModel model{60.0};
  for (const auto& [top, bottom] : {std::pair<double, double>{-110.0, -700.0}, {500.0, 30.0}, {-30.0, -60.0}}) {
    const ReconstructionResult result = HorizonReconstruction(small()).reconstruct(model.picks(), {StepModel::fault(top, bottom)});
    EXPECT_EQ(result.report.topology.components, 2U) << top;
    EXPECT_NEAR(result.report.faults[0].throw_.mean, 60.0, 5.0);
    EXPECT_TRUE(says(result.report.notes, "was extended along its dip"));
  }
  ReconstructionOptions off = small();
  off.extend_faults = 0.0;
  EXPECT_EQ(HorizonReconstruction(off).reconstruct(model.picks(), {StepModel::fault(-110.0, -700.0)}).report.faults[0].cut_vertices, 0U);
}

TEST(Faults, TheirOrderChangesNothing) {
  for (const SyntheticKind kind : {SyntheticKind::Branch, SyntheticKind::Cross}) {
    const SyntheticModel model = test::smallModel(kind);
    std::vector<FaultInput> faults = test::faultsOf(model);
    const ReconstructionResult one = HorizonReconstruction(small()).reconstruct(model.picks().points, faults);
    std::reverse(faults.begin(), faults.end());
    const ReconstructionResult other = HorizonReconstruction(small()).reconstruct(model.picks().points, faults);
    EXPECT_EQ(one.mesh.vertices, other.mesh.vertices);
    EXPECT_EQ(one.mesh.triangles, other.mesh.triangles);
    ASSERT_EQ(one.faults.size(), 2U);
    for (std::size_t f = 0; f < 2; ++f) {
      EXPECT_EQ(one.faults[f].name, other.faults[1 - f].name);
      EXPECT_EQ(one.report.faults[f].name, one.faults[f].name);
      EXPECT_EQ(other.report.faults[f].name, other.faults[f].name);
      EXPECT_EQ(one.report.faults[f].throw_.mean, other.report.faults[1 - f].throw_.mean);
      EXPECT_EQ(one.throws[f].size(), other.throws[1 - f].size());
    }
    for (std::size_t v = 0; v < one.vertex_faults.size(); ++v)
      for (std::size_t k = 0; k < 2; ++k)
        EXPECT_EQ(one.vertex_faults[v][k] < 0 ? -1 : 1 - one.vertex_faults[v][k], other.vertex_faults[v][k]);
  }
}

} // namespace
} // namespace graben
