#include "small_model.h"

#include "graben/mesh/normals.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>

namespace graben::test {
namespace {

/// How often the truth lies between P10 and P90, which should be four times out of five.
struct Calibration {
  std::size_t heights = 0, heights_within = 0;
  std::size_t throws = 0, throws_within = 0;
  double squared_scores = 0.0; ///< of throws: (error / deviation)^2

  double ofHeights() const { return static_cast<double>(heights_within) / static_cast<double>(heights); }
  double ofThrows() const { return static_cast<double>(throws_within) / static_cast<double>(throws); }
};

void judgeHeights(const SyntheticModel& model, const TriangleMesh& mesh, Calibration& c) {
  const std::vector<float>& deviation = mesh.scalars.at("height_sd");
  std::vector<char> seen(mesh.vertices.size(), 0);
  for (const Triangle& t : mesh.triangles) {
    Vector3 centre = Vector3::Zero();
    for (const Index v : t)
      centre += mesh.vertices[static_cast<std::size_t>(v)] / 3.0;
    const Index block = model.blockOf(centre);
    for (const Index v : t) {
      const auto i = static_cast<std::size_t>(v);
      const Vector3& p = mesh.vertices[i];
      if (seen[i] != 0 || !std::isfinite(deviation[i]) || std::max(std::abs(p.x()), std::abs(p.y())) > 0.5 * model.options().size)
        continue;
      seen[i] = 1;
      ++c.heights;
      const double error = p.z() - model.truthHeight(block, p.x(), p.y());
      c.heights_within += std::abs(error) <= kP90 * static_cast<double>(deviation[i]) ? 1 : 0;
    }
  }
}

/// The true throw straight across the fault: the truth's cutoffs by their place along the strike of a planar fault.
void judgeThrows(const SyntheticModel& model, const ReconstructionResult& result, Calibration& c) {
  const TriangleMesh fault = model.faultMesh(0);
  const Vector3 normal = areaNormal(fault, fault.triangles.front());
  const Vector3 strike = Vector3(-normal.y(), normal.x(), 0.0).normalized();
  std::map<int, std::map<double, double>> z;
  for (const TrueCutoffLine& line : model.cutoffLines())
    if (line.fault == 0)
      for (const Vector3& p : line.points)
        z[line.side][p.dot(strike)] = p.z();
  const auto at = [&](int side, double s) {
    const auto after = z[side].lower_bound(s);
    if (after == z[side].begin() || after == z[side].end())
      return std::numeric_limits<double>::quiet_NaN();
    const auto before = std::prev(after);
    return before->second + (s - before->first) / (after->first - before->first) * (after->second - before->second);
  };
  for (const ProfileRow& row : result.profiles[0].rows) {
    const double s = row.footwall.dot(strike);
    const double error = row.throw_ - (at(-1, s) - at(1, s));
    if (!std::isfinite(error) || !(row.deviation > 0.0))
      continue;
    ++c.throws;
    c.throws_within += std::abs(error) <= kP90 * row.deviation ? 1 : 0;
    c.squared_scores += std::pow(error / row.deviation, 2);
  }
}

Calibration calibrate(SyntheticKind kind, std::uint64_t seeds, const std::function<void(SyntheticOptions&)>& set) {
  Calibration c;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    SyntheticOptions o = SyntheticOptions::of(kind);
    o.seed = seed;
    o.picks = 6000;
    set(o);
    const SyntheticModel model(o);
    const ReconstructionResult result = HorizonReconstruction().reconstruct(model.picks().points, faultsOf(model));
    judgeHeights(model, result.mesh, c);
    judgeThrows(model, result, c);
  }
  return c;
}

/// Over few seeds: throws along one fault err together.
void expectFourOutOfFive(const Calibration& c) {
  EXPECT_GT(c.heights, 1000U);
  EXPECT_GT(c.throws, 50U);
  EXPECT_NEAR(c.ofHeights(), 0.8, 0.07);
  EXPECT_NEAR(c.ofThrows(), 0.8, 0.15);
  EXPECT_NEAR(std::sqrt(c.squared_scores / static_cast<double>(c.throws)), 1.0, 0.35);
}

TEST(Deviation, HoldsTheTruthFourTimesOutOfFive) {
  for (const SyntheticKind kind : {SyntheticKind::Normal, SyntheticKind::Reverse, SyntheticKind::Tip}) {
    SCOPED_TRACE(static_cast<int>(kind));
    expectFourOutOfFive(calibrate(kind, 3, [](SyntheticOptions&) {}));
  }
}

TEST(Deviation, GrowsWithTheNoise) {
  expectFourOutOfFive(calibrate(SyntheticKind::Normal, 2, [](SyntheticOptions& o) { o.noise = 6.0; }));
}

/// Where picks stop short of the fault, and between lines, the band is wide, and wide enough.
TEST(Deviation, IsWideWhereThereAreNoPicks) {
  const auto meanOf = [](const std::function<void(SyntheticOptions&)>& set) {
    SyntheticOptions o = SyntheticOptions::of(SyntheticKind::Normal);
    o.picks = 6000;
    set(o);
    const SyntheticModel model(o);
    return *HorizonReconstruction().reconstruct(model.picks().points, faultsOf(model)).report.throw_deviation;
  };
  const auto gap = [](SyntheticOptions& o) { o.gap = 150.0; };
  EXPECT_GT(meanOf(gap), 1.5 * meanOf([](SyntheticOptions&) {}));
  EXPECT_GT(calibrate(SyntheticKind::Normal, 1, gap).ofThrows(), 0.7);
  EXPECT_GT(calibrate(SyntheticKind::Normal, 1, [](SyntheticOptions& o) { o.sampling.kind = SyntheticSamplingKind::Lines; }).ofThrows(), 0.7);
}

TEST(Deviation, IsLeftOutWhereNotAskedFor) {
  ReconstructionOptions o;
  o.deviation = false;
  const SyntheticModel model = smallModel(SyntheticKind::Normal, 1500);
  const ReconstructionResult result = HorizonReconstruction(o).reconstruct(model.picks().points, faultsOf(model));
  EXPECT_EQ(result.mesh.scalars.count("height_sd"), 0U);
  EXPECT_FALSE(result.report.throw_deviation);
  EXPECT_TRUE(std::isnan(result.profiles[0].rows[0].deviation));
}

} // namespace
} // namespace graben::test
