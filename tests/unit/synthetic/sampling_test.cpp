#include "cases.h"

#include "graben/core/errors.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>

namespace graben {
namespace {

using test::EveryKind;
using Vector2 = Eigen::Vector2d;

constexpr double kDegree = 3.141592653589793 / 180.0;

SyntheticOptions sampled(SyntheticKind kind, SyntheticSamplingKind sampling) {
  SyntheticOptions o = SyntheticOptions::of(kind);
  o.patches.clear();
  o.sampling.kind = sampling;
  o.sampling.along = 25.0;
  return o;
}

class Sampling : public EveryKind {};

TEST_P(Sampling, SameBytesForEveryNumberOfThreads) {
  for (const SyntheticSamplingKind sampling : {SyntheticSamplingKind::Grid, SyntheticSamplingKind::Lines, SyntheticSamplingKind::Contours}) {
    SyntheticOptions o = sampled(GetParam(), sampling);
    o.sampling.line_distance = sampling == SyntheticSamplingKind::Grid ? 40.0 : 250.0;
    o.sampling.azimuth = 20.0;
    o.sampling.shadow = {60.0, 90.0};
    o.sampling.mistie = sampling == SyntheticSamplingKind::Lines ? 3.0 : 0.0;
    const SyntheticModel model(o);
    const SyntheticPicks one = model.picks(1);
    const SyntheticPicks four = model.picks(4);
    ASSERT_GT(one.points.size(), 2000u);
    ASSERT_EQ(one.points.size(), four.points.size());
    EXPECT_EQ(std::memcmp(one.points.data(), four.points.data(), one.points.size() * sizeof(Vector3)), 0);
    EXPECT_EQ(one.block, four.block);
    EXPECT_EQ(one.line, four.line);
    EXPECT_THROW(model.pick(0), InvalidInputError);
  }
}

TEST_P(Sampling, PicksLieOnTheirBlocksHorizon) {
  for (const SyntheticSamplingKind sampling : {SyntheticSamplingKind::Grid, SyntheticSamplingKind::Lines, SyntheticSamplingKind::Contours}) {
    SyntheticOptions o = sampled(GetParam(), sampling);
    o.sampling.line_distance = 200.0;
    o.noise = 0.0;
    const SyntheticModel model(o);
    const SyntheticPicks picks = model.picks();
    std::vector<int> count(model.blockCount());
    for (std::size_t i = 0; i < picks.points.size(); ++i) {
      ++count[static_cast<std::size_t>(picks.block[i])];
      EXPECT_LT(model.distanceToTruth(picks.block[i], picks.points[i]), sampling == SyntheticSamplingKind::Contours ? 0.05 : 1e-9);
    }
    for (const int n : count)
      EXPECT_GT(n, 50);
  }
}

TEST_P(Sampling, NoPickIsInTheShadow) {
  SyntheticOptions o = sampled(GetParam(), SyntheticSamplingKind::Grid);
  o.sampling.line_distance = 25.0;
  o.sampling.shadow = {100.0, 200.0};
  const SyntheticModel model(o);
  const SyntheticPicks picks = model.picks();
  for (const TrueCutoffLine& cutoff : model.cutoffLines(20.0)) {
    const double shadow = cutoff.side < 0 ? 100.0 : 200.0;
    for (std::size_t k = 0; k < cutoff.points.size(); k += 10) {
      const Vector3& at = cutoff.points[k];
      double nearest = 1e9;
      for (std::size_t i = 0; i < picks.points.size(); ++i)
        if (picks.block[i] == cutoff.block && (model.faultOffset(static_cast<std::size_t>(cutoff.fault), picks.points[i]) > 0.0) == (cutoff.side > 0))
          nearest = std::min(nearest, (picks.points[i] - at).head<2>().norm());
      EXPECT_GT(nearest, 0.98 * shadow) << "at " << at.transpose();
    }
  }
}

INSTANTIATE_TEST_SUITE_P(, Sampling, testing::ValuesIn(test::allKinds()), test::nameOf);

TEST(SampledLines, LieAtTheirDistancesInTheirDirections) {
  SyntheticOptions o = sampled(SyntheticKind::Unfaulted, SyntheticSamplingKind::Lines);
  o.sampling.line_distance = 400.0;
  o.sampling.cross_distance = 700.0;
  o.sampling.azimuth = 30.0;
  const SyntheticPicks picks = SyntheticModel(o).picks();
  std::map<Index, std::vector<Vector2>> lines; // along, across the first family
  for (std::size_t i = 0; i < picks.points.size(); ++i) {
    const Vector2 xy = picks.points[i].head<2>();
    lines[picks.line[i]].push_back(
        {xy.x() * std::sin(30 * kDegree) + xy.y() * std::cos(30 * kDegree), xy.x() * std::cos(30 * kDegree) - xy.y() * std::sin(30 * kDegree)});
  }
  double out[2] = {-1e9, -1e9};
  for (const auto& [number, points] : lines) {
    const int way = std::abs(points.front().y() - points.back().y()) < 1e-6 ? 0 : 1; // 1: the lines across
    for (std::size_t k = 1; k < points.size(); ++k) {
      EXPECT_NEAR(points[k][1 - way], points[0][1 - way], 1e-6);
      EXPECT_NEAR(std::abs(points[k][way] - points[k - 1][way]), 25.0, 1e-6);
    }
    if (out[way] > -1e9) {
      EXPECT_NEAR(std::abs(points[0][1 - way] - out[way]), way == 0 ? 400.0 : 700.0, 1e-6);
    }
    out[way] = points[0][1 - way];
  }
  EXPECT_EQ(lines.size(), 21u + 12u); // the square is 8196 m wide, seen so; the corners' lines are short
}

TEST(SampledLines, OutermostLinesLieOnTheEdgeWhereTheDistanceDividesTheSize) {
  for (const double azimuth : {0.0, 90.0, -90.0, 270.0}) {
    SyntheticOptions o = sampled(SyntheticKind::Unfaulted, SyntheticSamplingKind::Lines);
    o.sampling.line_distance = 400.0;
    o.sampling.azimuth = azimuth;
    const SyntheticPicks picks = SyntheticModel(o).picks();
    EXPECT_EQ(picks.points.size(), 16u * 241u) << azimuth;
  }
}

TEST(SampledGrid, HasItsNodes) {
  SyntheticOptions o = sampled(SyntheticKind::Unfaulted, SyntheticSamplingKind::Grid);
  o.sampling.line_distance = 100.0;
  EXPECT_EQ(SyntheticModel(o).picks().points.size(), 61u * 61u);
  o.sampling.cross_distance = 50.0;
  EXPECT_EQ(SyntheticModel(o).picks().points.size(), 61u * 121u);
}

TEST(SampledLines, AMistieMovesAWholeLine) {
  SyntheticOptions o = sampled(SyntheticKind::Normal, SyntheticSamplingKind::Lines);
  o.noise = 0.0;
  o.sampling.line_distance = 20.0;
  o.sampling.mistie = 3.0;
  const SyntheticModel model(o);
  const SyntheticPicks picks = model.picks();
  std::map<Index, double> off;
  for (std::size_t i = 0; i < picks.points.size(); ++i) {
    const Vector3& p = picks.points[i];
    const double mistie = p.z() - model.truthHeight(picks.block[i], p.x(), p.y());
    EXPECT_NEAR(off.try_emplace(picks.line[i], mistie).first->second, mistie, 1e-9);
  }
  ASSERT_EQ(off.size(), 301u);
  double squares = 0.0;
  for (const auto& [line, mistie] : off)
    squares += mistie * mistie;
  EXPECT_NEAR(std::sqrt(squares / 301.0), 3.0, 0.4);
}

TEST(SampledLines, UnpickedStretchesTakeTheirShare) {
  SyntheticOptions o = sampled(SyntheticKind::Unfaulted, SyntheticSamplingKind::Lines);
  o.sampling.line_distance = 50.0;
  const auto all = static_cast<double>(SyntheticModel(o).picks().points.size());
  o.sampling.unpicked_share = 0.3;
  o.sampling.unpicked_length = 500.0;
  const SyntheticPicks picks = SyntheticModel(o).picks();
  EXPECT_NEAR(static_cast<double>(picks.points.size()) / all, 0.7, 0.04);
  int gaps = 0;
  for (std::size_t i = 1; i < picks.points.size(); ++i) {
    const double step = (picks.points[i] - picks.points[i - 1]).head<2>().norm();
    if (picks.line[i] != picks.line[i - 1] || step < 26.0)
      continue;
    ++gaps;
    EXPECT_GT(step, 499.0);
  }
  EXPECT_GT(gaps, 200);
}

TEST(SampledContours, NoiseMovesPicksOnTheMap) {
  SyntheticOptions o = sampled(SyntheticKind::Branch, SyntheticSamplingKind::Contours);
  o.noise = 5.0;
  o.sampling.contour_interval = 20.0;
  const SyntheticPicks picks = SyntheticModel(o).picks();
  for (std::size_t i = 0; i < picks.points.size(); ++i) {
    const double levels = picks.points[i].z() / 20.0;
    EXPECT_NEAR(levels, std::round(levels), 1e-12);
  }
  o.noise = 0.0;
  const SyntheticPicks exact = SyntheticModel(o).picks();
  ASSERT_EQ(exact.points.size(), picks.points.size());
  double squares = 0.0;
  for (std::size_t i = 0; i < picks.points.size(); ++i)
    squares += (exact.points[i] - picks.points[i]).head<2>().squaredNorm();
  EXPECT_NEAR(std::sqrt(squares / static_cast<double>(picks.points.size())), 5.0 * std::sqrt(2.0), 0.2);
  int next = 0, near = 0;
  for (std::size_t i = 1; i < exact.points.size(); ++i)
    if (exact.line[i] == exact.line[i - 1]) {
      ++next;
      near += std::abs((exact.points[i] - exact.points[i - 1]).norm() - 25.0) < 1.0 ? 1 : 0;
    }
  EXPECT_GT(near, next * 9 / 10); // the others span what the fault cuts out
}

TEST(SampledGrid, ABridgeIsAStraightRampAcrossTheFault) {
  for (const SyntheticKind kind : {SyntheticKind::Normal, SyntheticKind::Reverse}) {
    SyntheticOptions o = sampled(kind, SyntheticSamplingKind::Grid);
    o.noise = 0.0;
    o.sampling.line_distance = 50.0;
    o.sampling.bridge = 150.0;
    const SyntheticModel model(o);
    const SyntheticPicks picks = model.picks();
    EXPECT_EQ(picks.points.size(), 121u * 121u); // one at each node, in the heave and where the sheets overlap
    int on_ramp = 0;
    for (std::size_t i = 0; i < picks.points.size(); ++i) {
      const Vector3& p = picks.points[i];
      const double up = model.truthHeight(0, p.x(), p.y()), down = model.truthHeight(1, p.x(), p.y());
      if (std::min(std::abs(p.z() - up), std::abs(p.z() - down)) < 1e-9)
        continue;
      ++on_ramp;
      EXPECT_LT(std::abs(model.faultOffset(0, p)), 400.0);
      EXPECT_GT(p.z(), std::min(up, down) - 40.0);
      EXPECT_LT(p.z(), std::max(up, down) + 40.0);
    }
    EXPECT_NEAR(on_ramp, 121 * 358 / 50, 60); // twice the bridge and a heave of 58 m across the fault
  }
}

TEST(SampledHorizon, TiltDipsWhereItIsAskedTo) {
  SyntheticOptions o = sampled(SyntheticKind::Tip, SyntheticSamplingKind::Lines);
  o.tilt = 40.0;
  o.tilt_azimuth = 90.0;
  o.relief = 0.0;
  o.max_throw = 10.0;
  const SyntheticModel model(o);
  const Vector3 normal = model.truthNormal(0, -2500.0, 2500.0);
  EXPECT_NEAR(std::acos(normal.z()) / kDegree, 40.0, 0.5);
  EXPECT_GT(normal.x(), 0.6);
  for (const TrueCutoffLine& line : model.cutoffLines())
    for (const Vector3& p : line.points)
      EXPECT_NEAR(model.faultOffset(0, p), 0.0, 1e-3);
}

TEST(FaultSticks, JitterMovesNodesAcrossTheFault) {
  SyntheticOptions o;
  o.stick_spacing = 12.5;
  const SyntheticModel exact(o);
  o.stick_jitter = 15.0;
  const SyntheticModel model(o);
  const std::vector<FaultStick> sticks = model.faultSticks(0), true_sticks = exact.faultSticks(0);
  ASSERT_EQ(sticks.size(), true_sticks.size());
  double sum = 0.0, squares = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < sticks.size(); ++i)
    for (std::size_t k = 0; k < sticks[i].points.size(); ++k, ++count) {
      EXPECT_EQ(sticks[i].points[k].z(), true_sticks[i].points[k].z());
      const double offset = model.faultOffset(0, sticks[i].points[k]);
      sum += offset;
      squares += offset * offset;
    }
  EXPECT_NEAR(std::sqrt(squares / count), 15.0, 0.5);
  EXPECT_NEAR(sum / count, 0.0, 1.5);
}

TEST(SamplingRoom, NoRoomIsAnError) {
  SyntheticOptions o = sampled(SyntheticKind::Normal, SyntheticSamplingKind::Lines);
  o.sampling.shadow = {6000.0, 6000.0};
  EXPECT_THROW(SyntheticModel(o).picks(), InvalidInputError);
}

} // namespace
} // namespace graben
