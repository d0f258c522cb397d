#include "unit/pipeline/picked/judged.h"

namespace graben {
namespace {

SyntheticOptions withShadow(double footwall, double hanging_wall) {
  SyntheticOptions o;
  o.size = 3000.0;
  o.relief = 30.0;
  o.noise = 0.3;
  o.sampling.kind = SyntheticSamplingKind::Grid;
  o.sampling.line_distance = 30.0;
  o.sampling.shadow = {footwall, hanging_wall};
  return o;
}

/// Carried on to the fault, or said which option would.
void expectRightOrSaid(const SyntheticModel& model, double shadow) {
  const test::Judged judged = test::judge(model, model.picks().points, 1.3 * shadow);
  if (!judged.says("fault-reach"))
    test::expectRight(judged, model, {0.6, 2.0, 4.0});
}

TEST(FaultShadow, OfAnAutotrackersGridIsCrossed) {
  SyntheticOptions o = withShadow(200.0, 200.0);
  o.size = 1600.0;
  o.relief = 10.0;
  o.sampling.line_distance = 16.0;
  expectRightOrSaid(SyntheticModel(o), 200.0);
}

TEST(FaultShadow, OnBothSidesIsCrossed) {
  expectRightOrSaid(SyntheticModel(withShadow(300.0, 300.0)), 300.0);
}

TEST(FaultShadow, OnOneSideIsCrossed) {
  expectRightOrSaid(SyntheticModel(withShadow(0.0, 300.0)), 300.0);
  expectRightOrSaid(SyntheticModel(withShadow(300.0, 0.0)), 300.0);
}

TEST(FaultShadow, OfThreeSpacingsIsCrossedByDefault) {
  const SyntheticModel model(withShadow(100.0, 100.0));
  test::expectRight(test::judge(model, model.picks().points, 130.0), model, {0.6, 1.0, 4.0});
}

/// However wide the gap is, the reach given is the one that counts.
TEST(FaultShadow, IsCrossedWithTheReachGiven) {
  const SyntheticModel model(withShadow(300.0, 300.0));
  ReconstructionOptions options;
  options.fault_reach = 500.0;
  test::expectRight(test::judge(model, model.picks().points, 390.0, options), model, {0.6, 2.0, 4.0});
}

} // namespace
} // namespace graben
