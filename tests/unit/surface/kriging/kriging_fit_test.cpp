#include "shapes.h"

#include "graben/surface/kriging_fit.h"

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
  KrigingResult result;

  explicit Fitted(const Points& picks, unsigned threads = 0, std::size_t most_nodes = 6000, const SurfaceCorrelation& given = {},
                  const std::vector<std::vector<LineShare>>& lines = {}) {
    KrigingOptions options;
    options.gap = 8.0;
    options.threads = threads;
    options.most_nodes = most_nodes;
    options.given = given;
    options.lines = lines;
    result = fitByKriging(cut, VertexCorners(cut.mesh), picks, {}, options);
  }
  double rms() const {
    double sum = 0.0;
    for (const Vector3& v : cut.mesh.vertices)
      sum += std::pow(v.z() - bent(v.x(), v.y()), 2);
    return std::sqrt(sum / static_cast<double>(cut.mesh.vertices.size()));
  }
};

TEST(KrigingFit, BendsSmoothlyBetweenLines) {
  const Fitted fitted(lines(0.0));
  EXPECT_LT(fitted.rms(), 0.15); // a tenth of the waves, whose length is seven gaps
  EXPECT_EQ(fitted.result.picks, 4U * 19U);
}

/// A net of lines, each off by something of its own.
struct Net {
  Points picks;
  std::vector<std::vector<LineShare>> lines;

  explicit Net(double mistie) {
    test::Random random(5);
    Index line = 0;
    for (double across = -20.0; across <= 20.0; across += 8.0)
      for (const bool along_x : {true, false}) {
        const double off = random.normal(mistie);
        for (double along = -20.0; along <= 20.0; along += 2.0) {
          const double x = along_x ? along : across, y = along_x ? across : along;
          picks.emplace_back(x, y, bent(x, y) + off + random.normal(0.02));
          lines.push_back({{line, 1.0}});
        }
        ++line;
      }
  }

  Fitted fitted(bool told) const {
    Fitted made(picks, 0, 6000, {}, told ? lines : std::vector<std::vector<LineShare>>());
    return made;
  }
};

TEST(KrigingFit, LinesThatAreOffBendNothingWhereTheyAreKnown) {
  const Net net(0.4);
  const Fitted known = net.fitted(true);
  EXPECT_LT(known.rms(), 0.22); // all lines together are off by the mean of twelve, 0.12 or so
  EXPECT_GT(net.fitted(false).rms(), known.rms());
  EXPECT_GT(known.result.mistie, 0.15);
  EXPECT_LT(known.result.mistie, 0.8);
}

TEST(KrigingFit, LinesThatTieAreFoundToTie) { EXPECT_EQ(Net(0.0).fitted(true).result.mistie, 0.0); }

TEST(KrigingFit, OfPicksFullOfNoiseStaysBelowIt) { EXPECT_LT(Fitted(lines(0.3)).rms(), 0.3); }

/// The picks tell how smooth the surface is: of a smooth one by a Gaussian correlation, of one with kinks by a rougher one.
TEST(KrigingFit, TheLikeliestCorrelationTellsKinksFromWaves) {
  EXPECT_EQ(Fitted(lines(0.01)).result.correlation.correlation, Correlation::Gaussian);
  Points kinked = lines(0.001);
  for (Vector3& p : kinked)
    p.z() = std::abs(p.x() - 3.0) + 0.5 * std::abs(p.x() + p.y()) + 0.7 * std::abs(p.x() + 9.0);
  EXPECT_NE(Fitted(kinked).result.correlation.correlation, Correlation::Gaussian);
}

TEST(KrigingFit, NoisierPicksAreFoundToBeSo) {
  EXPECT_GT(Fitted(lines(0.3)).result.correlation.noise, Fitted(lines(0.01)).result.correlation.noise);
}

/// What is not known stays near what is.
TEST(KrigingFit, DoesNotRunAwayFarFromPicks) {
  Points few;
  for (double x = -18.0; x <= -14.0; x += 1.0)
    few.emplace_back(x, -18.0, std::abs(std::remainder(x, 2.0)));
  for (const Vector3& v : Fitted(few).cut.mesh.vertices)
    EXPECT_LT(std::abs(v.z()), 10.0);
}

TEST(KrigingFit, WindowsMeetWithoutASeam) {
  const Points picks = lines(0.1);
  const Fitted whole(picks, 0, 6000, {Correlation::Gaussian, 10.0, 0.01}), windows(picks, 0, 400, {Correlation::Gaussian, 10.0, 0.01});
  double most = 0.0;
  for (std::size_t v = 0; v < whole.cut.mesh.vertices.size(); ++v)
    most = std::max(most, (whole.cut.mesh.vertices[v] - windows.cut.mesh.vertices[v]).norm());
  EXPECT_LT(most, 0.1);
}

TEST(KrigingFit, IsTheSameForEveryNumberOfThreads) {
  const Points picks = lines(0.1);
  EXPECT_EQ(Fitted(picks, 1, 400).cut.mesh.vertices, Fitted(picks, 3, 400).cut.mesh.vertices);
}

TEST(KrigingFit, WithoutPicksNothingMoves) {
  const CutMesh before = flat();
  const Fitted fitted(Points(5, Vector3::Constant(std::numeric_limits<double>::quiet_NaN())));
  EXPECT_EQ(fitted.result.picks, 0U);
  for (std::size_t v = 0; v < before.mesh.vertices.size(); ++v)
    EXPECT_LT((before.mesh.vertices[v] - fitted.cut.mesh.vertices[v]).norm(), 1e-9);
}

} // namespace
} // namespace graben
