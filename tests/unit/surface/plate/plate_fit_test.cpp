#include "shapes.h"

#include "graben/surface/plate_fit.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

namespace graben {
namespace {

double bent(double x, double y) { return 1.5 * std::sin(x / 9.0) * std::cos(y / 11.0) + 0.1 * x; }

/// Lines of picks 8 apart over the square [-20, 20]^2, a pick every 2 along them.
Points lines(double noise) {
  test::Random random(7);
  Points picks;
  for (double y = -20.0; y <= 20.0; y += 8.0)
    for (double x = -20.0; x <= 20.0; x += 2.0)
      picks.emplace_back(x, y, bent(x, y) + random.normal(noise));
  return picks;
}

/// A flat mesh over the square [-18, 18]^2.
CutMesh flat() {
  CutMesh cut;
  cut.mesh = test::flatGrid(36, 1.0);
  cut.vertex_faults.assign(cut.mesh.vertices.size(), {-1, -1});
  return cut;
}

struct Fitted {
  CutMesh cut = flat();
  PlateFitResult result;

  explicit Fitted(const Points& picks, unsigned threads = 0, std::size_t most_nodes = 6000,
                  const std::vector<PlateStiffness>& stiffness = PlateFitOptions().stiffness) {
    PlateFitOptions options;
    options.gap = 8.0;
    options.passes = 3;
    options.threads = threads;
    options.most_nodes = most_nodes;
    options.stiffness = stiffness;
    result = fitPlate(cut, VertexCorners(cut.mesh), picks, {}, options);
  }
  double rms() const {
    double sum = 0.0;
    for (const Vector3& v : cut.mesh.vertices)
      sum += std::pow(v.z() - bent(v.x(), v.y()), 2);
    return std::sqrt(sum / static_cast<double>(cut.mesh.vertices.size()));
  }
};

TEST(PlateFit, BendsSmoothlyBetweenLines) {
  const Fitted fitted(lines(0.0));
  EXPECT_LT(fitted.rms(), 0.15); // a tenth of the waves, whose length is seven gaps
  EXPECT_EQ(fitted.result.picks, 4U * 19U);
}

/// A plate that resists bending goes on straight beyond the last pick; one that resists change of bending goes on as it bends there.
TEST(PlateFit, OfTheThirdOrderCarriesABendOn) {
  const auto parabola = [](double x) { return 0.01 * x * x; };
  const auto missed = [&](int order) {
    Points picks;
    for (double x = -18.0; x <= 10.0; x += 1.0)
      for (double y = -18.0; y <= 18.0; y += 2.0)
        picks.emplace_back(x, y, parabola(x));
    CutMesh cut = flat();
    PlateFitOptions options;
    options.gap = 8.0;
    options.passes = 3;
    options.stiffness = {{order, 0.3}};
    fitPlate(cut, VertexCorners(cut.mesh), picks, {}, options);
    double most = 0.0;
    for (const Vector3& v : cut.mesh.vertices)
      if (v.x() > 15.0)
        most = std::max(most, std::abs(v.z() - parabola(v.x())));
    return most;
  };
  EXPECT_LT(missed(3), 0.5 * missed(2));
}

TEST(PlateFit, NoiseIsAveragedByALongerBendingLength) {
  const Fitted exact(lines(0.0)), noisy(lines(0.3));
    EXPECT_LT(noisy.rms(), 0.3);
}

TEST(PlateFit, WindowsMeetWithoutASeam) {
  const Points picks = lines(0.1);
  const Fitted whole(picks, 0, 6000, {{3, 0.2}}), windows(picks, 0, 400, {{3, 0.2}});
  double most = 0.0;
  for (std::size_t v = 0; v < whole.cut.mesh.vertices.size(); ++v)
    most = std::max(most, (whole.cut.mesh.vertices[v] - windows.cut.mesh.vertices[v]).norm());
  EXPECT_LT(most, 0.1);
}

TEST(PlateFit, IsTheSameForEveryNumberOfThreads) {
  const Points picks = lines(0.1);
  EXPECT_EQ(Fitted(picks, 1, 400).cut.mesh.vertices, Fitted(picks, 3, 400).cut.mesh.vertices);
}

TEST(PlateFit, WithoutPicksNothingMoves) {
  const CutMesh before = flat();
  const Fitted fitted(Points(5, Vector3::Constant(std::numeric_limits<double>::quiet_NaN())));
  EXPECT_EQ(fitted.result.picks, 0U);
  for (std::size_t v = 0; v < before.mesh.vertices.size(); ++v)
    EXPECT_LT((before.mesh.vertices[v] - fitted.cut.mesh.vertices[v]).norm(), 1e-9);
}

} // namespace
} // namespace graben
