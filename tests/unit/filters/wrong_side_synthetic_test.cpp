#include "synthetic_case.h"

#include <gtest/gtest.h>

namespace graben {
namespace {

const std::vector<SyntheticKind> kFaulted = {
    SyntheticKind::Normal,  SyntheticKind::Reverse, SyntheticKind::Tip,   SyntheticKind::Conjugate,
    SyntheticKind::Listric, SyntheticKind::Branch,  SyntheticKind::Cross, SyntheticKind::Relay};

SyntheticOptions optionsOf(SyntheticKind kind) {
  SyntheticOptions options = SyntheticOptions::of(kind);
  options.picks = 12000;
  return options;
}

test::Finding search(const SyntheticOptions& options) {
  const test::SyntheticCase job(options);
  return test::rate(job, findWrongSidePicks(job.grid, *job.faults));
}

std::string nameOf(SyntheticKind kind) {
  return syntheticKindNames()[static_cast<std::size_t>(kind)];
}

TEST(WrongSideSynthetic, LeavesGoodPicksAloneWhateverTheNoise) {
  for (const SyntheticKind kind : kFaulted)
    for (const double noise : {0.0, 24.0}) { // none, and half a spacing
      SyntheticOptions options = optionsOf(kind);
      options.noise = noise;
      const test::Finding finding = search(options);
      EXPECT_LE(finding.falsely, finding.judged / 1000) << nameOf(kind) << ", noise " << noise;
    }
}

TEST(WrongSideSynthetic, FindsPicksBetweenTheTrueFaultAndOneThatIsOff) {
  for (const SyntheticKind kind : kFaulted)
    for (const double shift : {-50.0, 80.0}) {
      SyntheticOptions options = optionsOf(kind);
      options.fault_shift = shift;
      const test::Finding finding = search(options);
      const bool tapers = kind == SyntheticKind::Tip || kind == SyntheticKind::Relay;
      EXPECT_GT(finding.wrong, 10U);
      EXPECT_GE(static_cast<double>(finding.found),
                (tapers ? 0.8 : 0.97) * static_cast<double>(finding.wrong))
          << nameOf(kind) << ", shift " << shift;
      EXPECT_LE(finding.falsely, finding.judged / 1000) << nameOf(kind) << ", shift " << shift;
    }
}

TEST(WrongSideSynthetic, FindsTheFewBesideAFaultThatIsHardlyOff) {
  SyntheticOptions options = optionsOf(SyntheticKind::Listric);
  options.fault_shift = 10.0;
  const test::Finding finding = search(options);
  EXPECT_GT(finding.wrong, 10U);
  EXPECT_GE(100 * finding.found, 97 * finding.wrong);
  EXPECT_EQ(finding.falsely, 0U);
}

TEST(WrongSideSynthetic, FindsPicksThatStandAloneBeyondALargeThrow) {
  SyntheticOptions options = optionsOf(SyntheticKind::Reverse);
  options.max_throw = 20.0 * options.spacing();
  options.noise = 10.0;
  const test::Finding finding = search(options);
  EXPECT_GT(finding.wrong, 10U);
  EXPECT_GE(100 * finding.found, 80 * finding.wrong);
  EXPECT_EQ(finding.falsely, 0U);
}

TEST(WrongSideSynthetic, FindsPicksThatNoiseCarriedThroughTheFault) {
  for (const SyntheticKind kind : {SyntheticKind::Normal, SyntheticKind::Reverse}) {
    SyntheticOptions options = SyntheticOptions::of(kind);
    options.noise = 0.5 * options.spacing();
    const test::Finding finding = search(options);
    EXPECT_GT(finding.wrong, 40U) << nameOf(kind);
    EXPECT_GE(2 * finding.found, finding.wrong) << nameOf(kind);
    EXPECT_LE(finding.falsely, finding.judged / 1000) << nameOf(kind);
  }
}

TEST(WrongSideSynthetic, FollowsAWideStripOfWrongPicksDownToTheFault) {
  SyntheticOptions options = SyntheticOptions::of(SyntheticKind::Listric);
  options.fault_shift = -100.0;
  const test::Finding finding = search(options);
  EXPECT_GE(100 * finding.found, 90 * finding.wrong); // one group beside the fault comes and goes with 1 % in the mean distance
  EXPECT_EQ(finding.falsely, 0U);
}

TEST(WrongSideSynthetic, FindsPicksMovedAcrossTheFault) {
  for (const SyntheticKind kind : {SyntheticKind::Normal, SyntheticKind::Branch}) {
    SyntheticOptions options = optionsOf(kind);
    options.smear = 80.0;
    const test::Finding finding = search(options);
    EXPECT_GE(100 * finding.found, 97 * finding.wrong) << nameOf(kind);
    EXPECT_LE(finding.falsely, finding.judged / 1000) << nameOf(kind);
  }
}

TEST(WrongSideSynthetic, LeavesTheLensBetweenTwoFaultsAlone) {
  for (const double distance : {60.0, 150.0})
    for (const SyntheticKind kind : {SyntheticKind::Parallel, SyntheticKind::Relay}) {
      SyntheticOptions options = SyntheticOptions::of(kind);
      options.picks = 30000;
      options.fault_distance = distance;
      const test::Finding finding = search(options);
      EXPECT_LE(finding.falsely, finding.judged / 1000) << nameOf(kind) << ", " << distance;
    }
}

TEST(WrongSideSynthetic, LeavesPicksAloneWhereTheGivenFaultStopsShort) {
  SyntheticOptions options = optionsOf(SyntheticKind::Normal);
  options.strike_overhang = -1000.0;
  EXPECT_EQ(search(options).falsely, 0U);
  options.strike_overhang = 300.0;
  options.overhang_above = -60.0;
  EXPECT_EQ(search(options).falsely, 0U);
}

TEST(WrongSideSynthetic, SkipsThrowsThatCannotMatter) {
  SyntheticOptions options = optionsOf(SyntheticKind::Normal);
  options.noise = 0.0;
  options.throw_variation = 0.0;
  options.max_throw = 6.0; // more than the tolerance, a tenth of the spacing, but hardly
  options.fault_shift = 50.0;
  const test::SyntheticCase job(options);
  const WrongSideResult result = findWrongSidePicks(job.grid, *job.faults);
  EXPECT_EQ(result.wrong_side + result.smeared, 0U);
}

} // namespace
} // namespace graben
