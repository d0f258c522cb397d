#include "shapes.h"

#include "graben/surface/local_fit.h"

#include <gtest/gtest.h>

#include <functional>

namespace graben {
namespace {

using Height = std::function<double(double, double)>;

/// Picks on a height field with noise, exact normals, and a mesh laid over the noisy picks.
struct Field {
  test::Oriented picks;
  TangentPlanes planes;
  NeighborGrid grid;
  FaultNetwork faults;
  Height height;

  Field(const Height& truth, double noise, std::vector<FaultSurface> fault_list = {})
      : faults(std::move(fault_list))
      , height(truth) {
    picks = test::sheet(20.0, 0.5, truth);
    test::Random random(9);
    for (Vector3& p : picks.points)
      p.z() += random.normal(noise);
    planes = picks.planes();
    grid = NeighborGrid(picks.points);
  }
  LocalFit fit() const { return LocalFit(grid, planes, faults, 8.0); }

  /// RMS of the inner vertices' heights over the truth.
  double rms(const TriangleMesh& mesh) const {
    double sum = 0.0;
    std::size_t count = 0;
    for (const Vector3& v : mesh.vertices)
      if (v.head<2>().cwiseAbs().maxCoeff() < 17.0) {
        sum += std::pow(v.z() - height(v.x(), v.y()), 2);
        ++count;
      }
    return std::sqrt(sum / static_cast<double>(count));
  }
  CutMesh start(double off) const {
    CutMesh cut;
    cut.mesh = test::flatGrid(36, 1.0);
    test::Random random(4);
    for (Vector3& v : cut.mesh.vertices)
      v.z() = height(v.x(), v.y()) + random.uniform(-off, off);
    cut.vertex_faults.assign(cut.mesh.vertices.size(), {-1, -1});
    return cut;
  }
  RefineOptions options() const {
    RefineOptions o;
    o.models = chooseModels(fit(), 3.0, 0);
    o.zone_width = 3.0;
    o.max_step = 1.0;
    return o;
  }
};

double gentle(double x, double y) {
  return 0.5 * std::sin(0.1 * x) * std::cos(0.08 * y);
}
double detailed(double x, double y) {
  return 0.5 * std::sin(0.9 * x) * std::cos(0.8 * y);
}

TEST(LocalFit, QuadricsAreExactOnQuadricsAndPlanesOnPlanes) {
  const auto bowl = [](double x, double y) { return 0.02 * x * x - 0.01 * x * y + 0.3 * y; };
  const Field field(bowl, 0.0);
  LocalFit::Scratch scratch;
  const Vector3 at(1.3, 2.2, bowl(1.3, 2.2) + 0.1);
  const Vector3 up = Vector3::UnitZ();
  const Index own = field.grid.nearestOne(at).index;
  const LocalEstimate exact = field.fit().at(at, at, up, {2, 40}, scratch, own);
  ASSERT_TRUE(exact.valid);
  EXPECT_NEAR(exact.offset, -0.1, 1e-4);
  EXPECT_LT(
      (exact.normal - Vector3(-(0.04 * 1.3 - 0.01 * 2.2), -(0.3 - 0.01 * 1.3), 1.0).normalized())
          .norm(),
      1e-3);
  EXPECT_GT(exact.leverage, 0.0);
  EXPECT_LT(exact.leverage, 1.0);
  const LocalEstimate flat = field.fit().at(at, at, up, {1, 40}, scratch);
  EXPECT_GT(std::abs(flat.offset + 0.1), 3e-4) << "a plane cannot follow the bowl";
  EXPECT_FALSE(field.fit().at({500, 0, 0}, {500, 0, 0}, up, {1, 40}, scratch).valid)
      << "no pick in reach";
}

TEST(LocalFit, UsesOnlyPicksOfItsOwnSide) {
  const auto step = [](double x, double) { return x < 0.0 ? 1.0 : -1.0; };
  const Field field(step, 0.0, {test::dippingFault(-40.0, 40.0, 15.0, 90.0)});
  LocalFit::Scratch scratch;
  for (const double side : {-1.0, 1.0}) {
    const Vector3 at(0.02 * side, 3.0, -side + 0.2);
    const LocalEstimate e = field.fit().at(at, at, Vector3::UnitZ(), {1, 30}, scratch);
    ASSERT_TRUE(e.valid);
    EXPECT_NEAR(e.offset, -0.2, 1e-6);
  }
}

TEST(LocalFit, PicksLookedUpForSeveralPlacesAtOnceAreThoseOfEach) {
  Field field(gentle, 0.2, {test::dippingFault(-40.0, 4.0, 15.0)});
  for (std::size_t i = 0; i < field.picks.points.size(); i += 7)
    field.picks.points[i].setConstant(std::numeric_limits<double>::quiet_NaN());
  field.grid = field.grid.withoutThoseTakenOut();
  const LocalFit fit = field.fit();
  test::Random random(3);
  for (int round = 0; round < 20; ++round) {
    Bounds box;
    box.extend({random.uniform(-18.0, 18.0), random.uniform(-18.0, 18.0), 0.0});
    box.extend(Vector3(box.low + Vector3(4.0, 2.0, 1.0)));
    LocalFit::Scratch together;
    fit.lookAround(box, 60, together);
    for (int place = 0; place < 20; ++place) {
      const double beyond = place % 5 == 0 ? 3.0 : 0.0; // places that were not announced
      const Vector3 at(random.uniform(box.low.x(), box.high.x() + beyond), random.uniform(box.low.y(), box.high.y()), random.uniform(0.0, 1.0));
      const LocalModel model{2, place % 7 == 0 ? 200U : 50U, 0.0}; // more picks than were
      LocalFit::Scratch alone;
      together.pace = 0.0;
      const LocalEstimate a = fit.at(at, at, Vector3::UnitZ(), model, alone), b = fit.at(at, at, Vector3::UnitZ(), model, together);
      ASSERT_EQ(alone.count, together.count);
      ASSERT_EQ(a.valid, b.valid);
      EXPECT_NEAR(a.offset, b.offset, 1e-9);
      EXPECT_LT((a.normal - b.normal).norm(), 1e-9);
    }
  }
}

TEST(Refine, NoiseIsAveragedNotCopied) {
  const Field field(gentle, 0.1);
  const RefineOptions options = field.options();
  EXPECT_GE(options.models.away.neighbors, 40U) << "with noise many picks win";
  EXPECT_NEAR(options.models.error_away, 0.1, 0.015) << "the error of prediction is then the noise";
  CutMesh cut = field.start(0.3);
  refine(cut, field.fit(), options);
  EXPECT_LT(field.rms(cut.mesh), 0.4 * 0.1);
}

TEST(Refine, WithoutNoiseDetailIsKept) {
  const Field field(detailed, 0.0);
  const RefineOptions options = field.options();
  EXPECT_GE(options.models.away.degree, 2);
  EXPECT_LE(options.models.away.neighbors, 25U) << "without noise few picks win";
  CutMesh cut = field.start(0.1);
  refine(cut, field.fit(), options);
  EXPECT_LT(field.rms(cut.mesh), 0.01) << "a fiftieth of the waves' height";
}

TEST(LocalFit, CubicsAreExactOnCubicsAndSteepDirections) {
  const auto wave = [](double x, double y) { return 0.002 * x * x * x - 0.003 * x * y * y + 0.4 * x; };
  const Field field(wave, 0.0);
  LocalFit::Scratch scratch;
  const Vector3 at(-2.1, 3.4, wave(-2.1, 3.4) + 0.2);
  const LocalEstimate e = field.fit().at(at, at, Vector3::UnitZ(), {3, 60}, scratch);
  ASSERT_TRUE(e.valid);
  EXPECT_NEAR(e.offset, -0.2, 1e-4);
  const Vector3 slant = Vector3(0.5, 0.0, 1.0).normalized();
  const LocalEstimate s = field.fit().at(at, at, slant, {3, 60}, scratch);
  const Vector3 foot = at + s.offset * slant;
  EXPECT_NEAR(foot.z(), wave(foot.x(), foot.y()), 1e-3);
}

TEST(Refine, BlundersDoNotPullTheSurface) {
  Field field(gentle, 0.1);
  const RefineOptions clean = field.options();
  CutMesh without = field.start(0.3);
  refine(without, field.fit(), clean);
  test::Random random(77);
  for (Vector3& p : field.picks.points)
    if (random.uniform(0.0, 1.0) < 0.01)
      p.z() += 3.0;
  field.grid = NeighborGrid(field.picks.points);
  CutMesh with = field.start(0.3);
  refine(with, field.fit(), field.options());
  EXPECT_LT(field.rms(with.mesh), 1.25 * field.rms(without.mesh));
}

TEST(Refine, ASharpBendInASmoothSurfaceIsKept) {
  const auto bump = [](double x, double y) { return gentle(x, y) + 1.5 * std::exp(-(x * x + y * y) / 3.0); };
  const Field field(bump, 0.1);
  const RefineOptions options = field.options();
  EXPECT_GT(options.models.away.neighbors, 45U) << "the support suits the most of the surface";
  CutMesh cut = field.start(0.1);
  refine(cut, field.fit(), options);
  double sum = 0.0, count = 0.0;
  for (const Vector3& v : cut.mesh.vertices)
    if (v.head<2>().norm() < 3.0) {
      sum += std::pow(v.z() - bump(v.x(), v.y()), 2);
      count += 1.0;
    }
  EXPECT_LT(std::sqrt(sum / count), 0.15);
}

TEST(Refine, SidesOfAFaultStayApart) {
  const auto step = [](double x, double) { return x < 0.0 ? 1.0 : -1.0; };
  const Field field(step, 0.05, {test::dippingFault(-40.0, 40.0, 15.0, 90.0)});
  CutMesh cut = field.start(0.1);
  refine(cut, field.fit(), field.options());
  for (const Vector3& v : cut.mesh.vertices)
    if (v.head<2>().cwiseAbs().maxCoeff() < 17.0 && std::abs(v.x()) > 0.01) {
      ASSERT_NEAR(v.z(), step(v.x(), 0.0), 0.08) << v.x() << ' ' << v.y();
    }
}

TEST(Refine, BetweenSparsePicksTheSurfaceFollowsMeasuredDips) {
  // Three picks to a wave: heights alone say little about what is between them, slopes do.
  const auto fold = [](double x, double) { return 0.8 * std::sin(0.55 * x); };
  Points points, normals;
  test::Random random(5);
  for (double x = -18.0; x <= 18.0; x += 3.6)
    for (double y = -18.0; y <= 18.0; y += 3.6) {
      const double at = x + random.uniform(-0.8, 0.8);
      points.emplace_back(at, y + random.uniform(-0.8, 0.8), fold(at, 0.0));
      normals.push_back(Vector3(-0.8 * 0.55 * std::cos(0.55 * at), 0.0, 1.0).normalized());
    }
  TangentPlanes planes;
  planes.centres = points;
  planes.normals = normals;
  const NeighborGrid grid(points);
  const FaultNetwork none;
  std::array<double, 2> rms{};
  for (const std::size_t dips : {0U, 1U}) {
    if (dips == 1)
      for (std::size_t i = 0; i < points.size(); ++i)
        planes.measured.push_back(static_cast<Index>(i));
    const LocalFit fit(grid, planes, none, 20.0);
    CutMesh cut;
    cut.mesh = test::flatGrid(28, 1.0);
    cut.vertex_faults.assign(cut.mesh.vertices.size(), {-1, -1});
    RefineOptions options;
    options.models = chooseModels(fit, 1.0, 0);
    refine(cut, fit, options);
    for (const Vector3& v : cut.mesh.vertices)
      rms[dips] += std::pow(v.z() - fold(v.x(), 0.0), 2) / static_cast<double>(cut.mesh.vertices.size());
  }
  EXPECT_GT(std::sqrt(rms[0]), 0.12) << "heights alone miss the folds: " << std::sqrt(rms[1]) << " with dips";
  EXPECT_LT(std::sqrt(rms[1]), 0.07);
}

TEST(Refine, ThreadsMakeNoDifference) {
  const Field field(gentle, 0.2, {test::dippingFault(-40.0, 4.0, 15.0)});
  RefineOptions options = field.options();
  CutMesh one = field.start(0.3), four = one;
  options.threads = 1;
  refine(one, field.fit(), options);
  options.threads = 4;
  refine(four, field.fit(), options);
  EXPECT_TRUE(test::sameMesh(one.mesh, four.mesh));
}

} // namespace
} // namespace graben
