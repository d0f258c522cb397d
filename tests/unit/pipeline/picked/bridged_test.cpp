#include "unit/pipeline/picked/judged.h"

namespace graben {
namespace {

/// A gridder has drawn a ramp across the fault: without the picks within the clearance the horizon is right.
TEST(BridgedGrid, IsRightWithAClearance) {
  SyntheticOptions o;
  o.size = 3000.0;
  o.relief = 30.0;
  o.noise = 0.3;
  o.sampling.kind = SyntheticSamplingKind::Grid;
  o.sampling.line_distance = 30.0;
  o.sampling.bridge = 75.0;
  const SyntheticModel model(o);
  ReconstructionOptions options;
  options.clearance = 125.0;
  const test::Judged judged = test::judge(model, model.picks().points, 160.0, options);
  EXPECT_GT(judged.result.report.picks_at_faults, 500U);
  if (!judged.says("fault-reach"))
    test::expectRight(judged, model, {0.6, 1.5, 4.0});
}

/// Without one it is said.
TEST(BridgedGrid, IsSaidWithTheOptionToUse) {
  SyntheticOptions o;
  o.size = 3000.0;
  o.relief = 30.0;
  o.noise = 0.3;
  o.sampling.kind = SyntheticSamplingKind::Grid;
  o.sampling.line_distance = 30.0;
  EXPECT_FALSE(test::judge(SyntheticModel(o), SyntheticModel(o).picks().points, 60.0).says("--clearance"));
  o.sampling.bridge = 75.0;
  EXPECT_TRUE(test::judge(SyntheticModel(o), SyntheticModel(o).picks().points, 60.0).says("--clearance"));
}

} // namespace
} // namespace graben
