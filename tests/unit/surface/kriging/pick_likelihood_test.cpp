#include "kriging/pick_likelihood.h"

#include "shapes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace graben {
namespace {

using detail::KrigedPlaces;
using detail::PickLikelihood;

constexpr double kLength = 10.0;
constexpr double kNoise = 0.05;

/// Lines of picks 6 apart on a surface of Gaussian correlation, whose standard deviation is 1: a sum of waves.
KrigedPlaces picksOnLines() {
  constexpr std::size_t kWaves = 400;
  test::Random random(11);
  std::vector<Vector3> waves; // across x, across y, phase
  for (std::size_t i = 0; i < kWaves; ++i)
    waves.emplace_back(random.normal(1.0 / kLength), random.normal(1.0 / kLength), random.normal(100.0));
  KrigedPlaces picks;
  for (double y = 0.0; y < 120.0; y += 6.0)
    for (double x = 0.0; x < 120.0; x += 1.0) {
      double z = random.normal(kNoise);
      for (const Vector3& wave : waves)
        z += std::sqrt(2.0 / static_cast<double>(kWaves)) * std::cos(wave.x() * x + wave.y() * y + wave.z());
      picks.place.emplace_back(x, y, z);
    }
  picks.normal.assign(picks.place.size(), Vector3::UnitZ());
  picks.sight = picks.place;
  return picks;
}

TEST(PickLikelihood, IsLargestAtTheCorrelationByWhichThePicksWereMade) {
  const KrigedPlaces picks = picksOnLines();
  const PickLikelihood likelihood(picks, {}, 6.0, 0);
  const auto unlikeliness = [&](const SurfaceCorrelation& correlation) { return likelihood.of(correlation).unlikeliness; };
  const double true_one = unlikeliness({Correlation::Gaussian, kLength, kNoise});
  for (const double factor : {0.7, 1.4}) {
    EXPECT_LT(true_one, unlikeliness({Correlation::Gaussian, factor * kLength, kNoise}));
    EXPECT_LT(true_one, unlikeliness({Correlation::Gaussian, kLength, factor * factor * kNoise}));
  }
  EXPECT_LT(true_one, unlikeliness({Correlation::Matern3over2, kLength, kNoise}));
  EXPECT_LT(true_one, unlikeliness({Correlation::Matern5over2, 2.0 * kLength, kNoise}));
}

TEST(PickLikelihood, IsTheSameForAnyNumberOfThreads) {
  const KrigedPlaces picks = picksOnLines();
  const SurfaceCorrelation correlation = {Correlation::Gaussian, kLength, kNoise};
  EXPECT_EQ(PickLikelihood(picks, {}, 6.0, 1).of(correlation).unlikeliness, PickLikelihood(picks, {}, 6.0, 3).of(correlation).unlikeliness);
}

TEST(PickLikelihood, NoPicksTellNothing) { EXPECT_FALSE(std::isfinite(PickLikelihood({}, {}, 6.0, 0).of({Correlation::Gaussian, 1.0, 0.1}).unlikeliness)); }

} // namespace
} // namespace graben
