#include "unit/pipeline/picked/judged.h"

namespace graben {
namespace {

/// Lines of picks \a along metres apart; \a across: the distance of lines across them, 0 for none. Lines to the east are dip lines.
SyntheticModel linesModel(SyntheticKind kind, double size, double distance, double across, double along) {
  SyntheticOptions o = SyntheticOptions::of(kind);
  o.patches.clear();
  o.holes.clear();
  o.size = size;
  o.relief = 0.01 * size;
  o.noise = 1.0;
  o.sampling.kind = SyntheticSamplingKind::Lines;
  o.sampling.azimuth = 90.0;
  o.sampling.line_distance = distance;
  o.sampling.cross_distance = across;
  o.sampling.along = along;
  return SyntheticModel(o);
}

TEST(PicksOnLines, AreJoinedRoundATip) {
  const SyntheticModel model = linesModel(SyntheticKind::Tip, 4000.0, 250.0, 250.0, 25.0);
  test::expectRight(test::judge(model, model.picks().points, 130.0), model, {0.6, 1.2, 4.0});
}

TEST(PicksOnLines, MistiesAreAveraged) {
  SyntheticOptions o = linesModel(SyntheticKind::Normal, 4000.0, 250.0, 250.0, 25.0).options();
  o.sampling.mistie = 3.0;
  const SyntheticModel model(o);
  test::expectRight(test::judge(model, model.picks().points, 130.0), model, {2.5, 2.5, 6.0});
}

} // namespace
} // namespace graben
