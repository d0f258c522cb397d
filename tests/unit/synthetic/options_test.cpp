#include "cases.h"

#include "graben/core/errors.h"

#include <gmock/gmock.h>

#include <functional>
#include <limits>

namespace graben {
namespace {

TEST(SyntheticOptions, BadValuesAreRejected) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<std::function<void(SyntheticOptions&)>> mistakes = {
      [](SyntheticOptions& o) { o.picks = 0; },
      [](SyntheticOptions& o) { o.size = 0.0; },
      [nan](SyntheticOptions& o) { o.size = nan; },
      [](SyntheticOptions& o) { o.relief = 1000.0; },
      [](SyntheticOptions& o) { o.noise = -1.0; },
      [nan](SyntheticOptions& o) { o.noise = nan; },
      [](SyntheticOptions& o) { o.uneven = 1.1; },
      [nan](SyntheticOptions& o) { o.uneven = nan; },
      [](SyntheticOptions& o) {
        o.holes = {{0.0, 0.0, -5.0}};
      },
      [](SyntheticOptions& o) {
        o.patches = {{{0.0, 0.0, 5.0}, 0.5}};
      },
      [](SyntheticOptions& o) { o.gap = -1.0; },
      [](SyntheticOptions& o) { o.smear = -1.0; },
      [](SyntheticOptions& o) { o.max_throw = 5000.0; },
      [](SyntheticOptions& o) { o.throw_variation = 2.1; },
      [](SyntheticOptions& o) { o.dip = 5.0; },
      [](SyntheticOptions& o) { o.dip = 91.0; },
      [](SyntheticOptions& o) { o.bend = 45.0; },
      [](SyntheticOptions& o) { o.waviness = 500.0; },
      [](SyntheticOptions& o) { o.fault_mesh_size = 0.0; },
      [](SyntheticOptions& o) { o.stick_spacing = 0.0; },
      [](SyntheticOptions& o) { o.points_per_stick = 1; },
      [](SyntheticOptions& o) { o.overhang_above = -400.0; },
      [](SyntheticOptions& o) { o.strike_overhang = -5000.0; },
      [](SyntheticOptions& o) { o.stick_jitter = -1.0; },
      [](SyntheticOptions& o) { o.tilt = 60.0; },
      [](SyntheticOptions& o) { o.dip = o.tilt = 40.0; },
      [](SyntheticOptions& o) { o.sampling.line_distance = 0.0; },
      [nan](SyntheticOptions& o) { o.sampling.line_distance = nan; },
      [](SyntheticOptions& o) { o.sampling.cross_distance = -100.0; },
      [](SyntheticOptions& o) { o.sampling.along = 0.0; },
      [nan](SyntheticOptions& o) { o.sampling.azimuth = nan; },
      [](SyntheticOptions& o) { o.sampling.contour_interval = 0.0; },
      [](SyntheticOptions& o) { o.sampling.shadow = {0.0, -1.0}; },
      [](SyntheticOptions& o) { o.sampling.bridge = o.sampling.shadow[0] = 50.0; },
      [](SyntheticOptions& o) { o.sampling.mistie = 2.0; },
      [](SyntheticOptions& o) {
        o.sampling.kind = SyntheticSamplingKind::Lines;
        o.sampling.unpicked_share = 0.2;
      },
      [](SyntheticOptions& o) {
        o.sampling.kind = SyntheticSamplingKind::Grid;
        o.patches = {{{0.0, 0.0, 500.0}, 2.0}};
      },
      [nan](SyntheticOptions& o) { o.frame.origin.x() = nan; },
      [](SyntheticOptions& o) { o.frame.z_scale = 0.0; },
  };
  for (std::size_t i = 0; i < mistakes.size(); ++i) {
    SyntheticOptions o;
    mistakes[i](o);
    EXPECT_THROW(SyntheticModel{o}, InvalidInputError) << "mistake " << i;
  }
}

TEST(SyntheticOptions, FaultsThatWouldMeetAreRejected) {
  SyntheticOptions o = SyntheticOptions::of(SyntheticKind::Conjugate);
  o.fault_distance = 100.0;
  EXPECT_THROW(SyntheticModel{o}, InvalidInputError);
  o = SyntheticOptions::of(SyntheticKind::Parallel);
  o.fault_distance = 122.0; // five spacings
  EXPECT_EQ(SyntheticModel(o).blockCount(), 3u);
}

TEST(SyntheticOptions, NamesFollowTheKinds) {
  EXPECT_EQ(syntheticKindNames().size(), static_cast<std::size_t>(SyntheticKind::Benchmark) + 1);
  EXPECT_EQ(syntheticKindNames()[static_cast<std::size_t>(SyntheticKind::Relay)], "relay");
}

TEST(SyntheticOptions, BlocksAndFaultsOfEachKind) {
  const std::vector<std::size_t> faults = {0, 1, 1, 1, 2, 2, 1, 2, 2, 2, 2};
  const std::vector<std::size_t> blocks = {1, 2, 2, 1, 3, 3, 2, 3, 4, 1, 2};
  for (const SyntheticKind kind : test::allKinds()) {
    const SyntheticModel model(SyntheticOptions::of(kind));
    EXPECT_EQ(model.faultCount(), faults[static_cast<std::size_t>(kind)]);
    EXPECT_EQ(model.blockCount(), blocks[static_cast<std::size_t>(kind)]);
  }
}

TEST(SyntheticOptions, SweepsOfThrowAndDipStayClean) {
  for (const SyntheticKind kind : test::allKinds())
    for (const double dip : {30.0, 60.0, 90.0})
      for (const double largest : {24.5, 490.0}) {
        SyntheticOptions o = SyntheticOptions::of(kind);
        o.dip = dip;
        o.max_throw = largest;
        o.picks = 3000;
        const SyntheticModel model(o);
        EXPECT_EQ(model.picks().points.size(), 3000u);
        for (const TriangleMesh& mesh : model.truthMeshes(100.0))
          EXPECT_GT(mesh.triangles.size(), 300u);
      }
}

} // namespace
} // namespace graben
