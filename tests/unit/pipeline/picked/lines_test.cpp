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

TEST(PicksOnLines, SquaresBetweenThemAreFilled) {
  const SyntheticModel model = linesModel(SyntheticKind::Unfaulted, 5000.0, 500.0, 500.0, 25.0);
  test::expectRight(test::judge(model, model.picks().points, 260.0), model, {1.0, 1.0, 0.0});
}

TEST(PicksOnLines, ParallelLinesMakeOneSheet) {
  const SyntheticModel model = linesModel(SyntheticKind::Unfaulted, 4000.0, 250.0, 0.0, 25.0);
  test::expectRight(test::judge(model, model.picks().points, 130.0), model, {1.0, 1.0, 0.0});
}

TEST(PicksOnLines, DipLinesWithStrikeLinesTwiceAsFarApart) {
  for (const double distance : {500.0, 1000.0}) {
    const SyntheticModel model = linesModel(SyntheticKind::Normal, 6.0 * distance, distance, 2.0 * distance, 0.05 * distance);
    test::expectRight(test::judge(model, model.picks().points, 0.52 * distance), model, {0.002 * distance, 0.004 * distance, 6.0});
  }
}

TEST(PicksOnLines, EveryFourthInlineAndCrossline) {
  const SyntheticModel model = linesModel(SyntheticKind::Normal, 3000.0, 100.0, 100.0, 25.0);
  test::expectRight(test::judge(model, model.picks().points, 60.0), model, {0.6, 1.0, 4.0});
}

TEST(PicksOnLines, EveryTwentiethInlineAndCrossline) {
  const SyntheticModel model = linesModel(SyntheticKind::Normal, 4000.0, 500.0, 500.0, 25.0);
  test::expectRight(test::judge(model, model.picks().points, 260.0), model, {0.6, 1.0, 4.0});
}

TEST(PicksOnLines, EveryTenthInlineWithoutCrosslines) {
  const SyntheticModel model = linesModel(SyntheticKind::Reverse, 4000.0, 250.0, 0.0, 25.0);
  test::expectRight(test::judge(model, model.picks().points, 130.0), model, {0.6, 1.0, 4.0});
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
