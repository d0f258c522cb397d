#include "unit/pipeline/small_model.h"

#include <gtest/gtest.h>

#include <set>

namespace graben {
namespace {

TEST(SkippedSteps, EachNameMarksOneStep) {
  std::set<std::vector<std::string>> found;
  for (const SkippableStep& step : skippableSteps()) {
    SkippedSteps skip;
    ASSERT_TRUE(skipStep(skip, step.name));
    EXPECT_EQ(names(skip), std::vector<std::string>{step.name});
    found.insert(names(skip));
  }
  EXPECT_EQ(found.size(), sizeof(SkippedSteps));
  SkippedSteps skip;
  EXPECT_FALSE(skipStep(skip, "everything"));
  EXPECT_TRUE(names(skip).empty());
}

TEST(SkippedSteps, PlainHoppeDrawsACurtainOverTheFault) {
  const SyntheticModel model = test::smallModel(SyntheticKind::Normal, 1500);
  ReconstructionOptions o;
  o.threads = 1;
  const ReconstructionResult whole = HorizonReconstruction(o).reconstruct(model.picks().points, test::faultsOf(model));
  for (const char* step : {"neighbors", "sides", "cut", "wrong-side", "tidy"})
    ASSERT_TRUE(skipStep(o.skip, step));
  o.fit = FitMode::Off;
  const ReconstructionResult plain = HorizonReconstruction(o).reconstruct(model.picks().points, test::faultsOf(model));
  EXPECT_EQ(whole.report.topology.components, 2U);
  EXPECT_EQ(whole.report.bridging_triangles, 0U);
  EXPECT_EQ(plain.report.topology.components, 1U);
  EXPECT_GT(plain.report.bridging_triangles, 20U);
  EXPECT_EQ(plain.report.used.skipped.size(), 5U);
  EXPECT_NE(toJson(plain.report).find("\"wrong-side\""), std::string::npos);
}

/// A step whose absence changed nothing would be a dead switch; tidy finds nothing to do in so small a case, and here are no shadows.
TEST(SkippedSteps, EachStepChangesTheSurface) {
  SyntheticOptions o = SyntheticOptions::of(SyntheticKind::Normal);
  o.picks = 800;
  o.smear = 150.0;
  const SyntheticModel model(o);
  const Points picks = model.picks().points;
  const std::vector<FaultInput> faults = test::faultsOf(model);
  std::set<std::vector<double>> different;
  for (std::size_t step = 0; step <= skippableSteps().size(); ++step) {
    ReconstructionOptions options;
    options.threads = 1;
    const std::string name = step < skippableSteps().size() ? skippableSteps()[step].name : "none";
    if (name == "tidy" || name == "shadows")
      continue;
    skipStep(options.skip, name);
    std::vector<double> coordinates;
    for (const Vector3& p : HorizonReconstruction(options).reconstruct(picks, faults).mesh.vertices)
      coordinates.insert(coordinates.end(), p.data(), p.data() + 3);
    EXPECT_TRUE(different.insert(coordinates).second) << name;
  }
}

TEST(SkippedSteps, WithoutShadowsTheSurfaceEndsWherePicksDo) {
  SyntheticOptions o = SyntheticOptions::of(SyntheticKind::Normal);
  o.picks = 6000;
  o.sampling.shadow = {500.0, 500.0};
  const SyntheticModel model(o);
  ReconstructionOptions options;
  const ReconstructionResult whole = HorizonReconstruction(options).reconstruct(model.picks().points, test::faultsOf(model));
  ASSERT_TRUE(skipStep(options.skip, "shadows"));
  const ReconstructionResult without = HorizonReconstruction(options).reconstruct(model.picks().points, test::faultsOf(model));
  ASSERT_EQ(whole.report.faults.size(), 1U);
  EXPECT_GT(whole.report.faults[0].cut_vertices, 50U);
  EXPECT_EQ(whole.report.shadows.found.size(), 2U);
  EXPECT_EQ(without.report.faults[0].cut_vertices, 0U);
}

} // namespace
} // namespace graben
