#include "unit/pipeline/small_model.h"

#include "graben/core/errors.h"
#include "graben/core/memory.h"

#include <gtest/gtest.h>

namespace graben {
namespace {

ReconstructionResult reconstruct(double noise_in_spacings, const ReconstructionOptions& options) {
  SyntheticOptions o = SyntheticOptions::of(SyntheticKind::Normal);
  o.picks = 1500;
  o.noise = noise_in_spacings * o.spacing();
  const SyntheticModel model(o);
  return HorizonReconstruction(options).reconstruct(model.picks().points, test::faultsOf(model));
}

TEST(Parameters, PlanesAreFittedToMorePicksWhereTheNoiseIsLarge) {
  ReconstructionOptions options;
  options.fit = FitMode::Off;
  EXPECT_EQ(reconstruct(0.05, options).report.used.neighbors, 15U);
  const ReconstructionResult noisy = reconstruct(0.5, options);
  EXPECT_GE(noisy.report.used.neighbors, 40U);
  EXPECT_LE(noisy.report.used.neighbors, 60U);
  options.neighbors = 15;
  EXPECT_EQ(reconstruct(0.5, options).report.used.neighbors, 15U);
}

TEST(Parameters, WhatTheProcessHasTakenCountsAgainstTheMemoryLimit) {
  ReconstructionOptions options;
  options.fit = FitMode::Off;
  constexpr std::size_t megabyte = 1'000'000;
  options.memory_limit = residentMemory() + megabyte / 10;
  EXPECT_THROW(reconstruct(0.05, options), ResourceError);
  options.memory_limit = residentMemory() + 100 * megabyte;
  EXPECT_FALSE(reconstruct(0.05, options).mesh.empty());
}

} // namespace
} // namespace graben
