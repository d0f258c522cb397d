#include "graben/pipeline/held_out.h"
#include "graben/pipeline/realizations.h"

#include "small_model.h"

#include "graben/core/errors.h"

#include <gtest/gtest.h>

#include <cmath>

namespace graben::test {
namespace {

TEST(Realizations, VaryWithTheNoiseAndNoMoreThanTheQuickDeviationSays) {
  SyntheticOptions o = SyntheticOptions::of(SyntheticKind::Normal);
  o.picks = 1500;
  o.noise = 4.0;
  const SyntheticModel model(o);
  const ReconstructionResult once = HorizonReconstruction().reconstruct(model.picks().points, faultsOf(model));
  ReconstructionResult result = once;
  RealizationOptions four;
  four.count = 4;
  realizeThrows(result, faultsOf(model), {}, four);
  double quick = 0.0, resampled = 0.0;
  std::size_t rows = 0;
  for (const ProfileRow& row : result.profiles[0].rows) {
    if (!std::isfinite(row.realized_deviation))
      continue;
    EXPECT_LE(row.realized_low, row.realized_high);
    quick += row.deviation * row.deviation;
    resampled += row.realized_deviation * row.realized_deviation;
    ++rows;
  }
  EXPECT_GT(rows, 5U);
  EXPECT_GT(quick, 0.5 * resampled);
  const double deviation = std::sqrt(resampled / static_cast<double>(rows)) / o.noise;
  EXPECT_GT(deviation, 0.2);
  EXPECT_LT(deviation, 1.5);
  ReconstructionResult again = once;
  realizeThrows(again, faultsOf(model), {}, four);
  EXPECT_EQ(again.profiles[0].rows[2].realized_deviation, result.profiles[0].rows[2].realized_deviation);
}

TEST(Realizations, WantPicksAndEnoughOfThemselves) {
  ReconstructionResult nothing;
  EXPECT_THROW(realizeThrows(nothing, {}, {}, {}), InvalidInputError);
  nothing.picks.resize(5);
  RealizationOptions few;
  few.count = 3;
  EXPECT_THROW(realizeThrows(nothing, {}, {}, few), InvalidInputError);
}

TEST(HeldOut, AreMissedByTheirNoise) {
  SyntheticOptions o = SyntheticOptions::of(SyntheticKind::Tip);
  o.picks = 4000;
  o.noise = 4.0;
  const SyntheticModel model(o);
  ReconstructionResult result = HorizonReconstruction().reconstruct(model.picks().points, faultsOf(model));
  EXPECT_FALSE(result.report.held_out.has_value());
  measureHeldOut(result, faultsOf(model), {}, {});
  ASSERT_TRUE(result.report.held_out.has_value());
  EXPECT_NEAR(static_cast<double>(result.report.held_out->count), 400.0, 60.0);
  EXPECT_GT(result.report.held_out->rms, result.report.all_picks.rms) << "they had no say";
  EXPECT_NEAR(result.report.held_out->rms, o.noise, 0.25 * o.noise);
}

} // namespace
} // namespace graben::test
