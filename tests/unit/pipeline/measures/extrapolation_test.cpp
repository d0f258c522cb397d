#include "unit/pipeline/small_model.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace graben {
namespace {

ReconstructionResult reconstruct(const SyntheticModel& model, double fault_reach = 0.0) {
  ReconstructionOptions o;
  o.threads = 1;
  o.fault_reach = fault_reach;
  return HorizonReconstruction(o).reconstruct(model.picks().points, test::faultsOf(model));
}

double nearestPick(const Vector3& p, const Points& picks) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Vector3& pick : picks)
    nearest = std::min(nearest, (pick - p).norm());
  return nearest;
}

TEST(Extrapolation, WithoutFaultsIsTheDistanceToTheNearestPick) {
  const SyntheticModel model = test::smallModel(SyntheticKind::Unfaulted, 1500);
  const ReconstructionResult result = reconstruct(model);
  const Points picks = model.picks().points;
  const std::vector<float>& distance = result.mesh.scalars.at("pick_distance");
  ASSERT_EQ(distance.size(), result.mesh.vertices.size());
  for (std::size_t v = 0; v < distance.size(); v += 7)
    EXPECT_NEAR(distance[v], nearestPick(result.mesh.vertices[v], picks), 1e-3);
}

/// Where picks stop 250 m short of the fault the sheets are carried on to it, and say so.
TEST(Extrapolation, AGapAtAFaultIsMarkedAndCounted) {
  SyntheticOptions o = SyntheticOptions::of(SyntheticKind::Normal);
  o.picks = 6000;
  const ReconstructionResult full = reconstruct(SyntheticModel(o), 500.0);
  o.gap = 250.0;
  const SyntheticModel model(o);
  const ReconstructionResult result = reconstruct(model, 500.0);
  const Extrapolation& found = result.report.extrapolation;
  EXPECT_LT(full.report.extrapolation.area_share, 0.005);
  EXPECT_GT(found.area_share, 0.01);
  EXPECT_LT(found.area_share, 0.1);
  const std::vector<float>& distance = result.mesh.scalars.at("pick_distance");
  const std::vector<float>& marked = result.mesh.scalars.at("extrapolated");
  std::size_t count = 0;
  for (std::size_t v = 0; v < distance.size(); ++v) {
    EXPECT_EQ(marked[v] > 0.0F, distance[v] > found.limit);
    count += marked[v] > 0.0F ? 1 : 0;
    const bool on_fault = result.vertex_faults[v][0] >= 0;
    EXPECT_TRUE(!on_fault || distance[v] > 200.0F);
  }
  EXPECT_EQ(count, found.vertices);
  EXPECT_NE(toJson(result.report).find("\"extrapolation\""), std::string::npos);
}

/// Picks across a fault do not count, however near: one side's picks are taken away.
TEST(Extrapolation, PicksBehindAFaultDoNotCount) {
  const SyntheticModel model = test::smallModel(SyntheticKind::Normal, 6000);
  Points picks;
  for (const Vector3& p : model.picks().points)
    if (model.faultOffset(0, p) < 0.0 || model.faultOffset(0, p) > 200.0)
      picks.push_back(p);
  ReconstructionOptions o;
  o.threads = 1;
  o.fault_reach = 500.0;
  const ReconstructionResult result = HorizonReconstruction(o).reconstruct(picks, test::faultsOf(model));
  const std::vector<float>& distance = result.mesh.scalars.at("pick_distance");
  std::size_t far = 0;
  std::size_t hidden = 0;
  for (std::size_t v = 0; v < distance.size(); ++v)
    if (result.vertex_faults[v][0] >= 0 && distance[v] > 200.0F) {
      ++far;
      hidden += nearestPick(result.mesh.vertices[v], picks) < 190.0 ? 1 : 0;
    }
  EXPECT_GT(far, 20U);
  EXPECT_GT(hidden, far / 2);
}

} // namespace
} // namespace graben
