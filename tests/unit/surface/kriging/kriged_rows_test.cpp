#include "kriging/kriged_rows.h"

#include "shapes.h"

#include "graben/mesh/normals.h"

#include <gtest/gtest.h>

#include <numeric>

namespace graben {
namespace {

using detail::KrigedRow;
using detail::KrigedRows;
using detail::KrigingNodes;

/// A square of 20 by 20 whose every vertex is a node, of given heights, beside a vertical fault along x = 0.5 or none.
struct Square {
  CutMesh cut;
  KrigingNodes nodes;
  FaultNetwork faults;

  template <typename Height>
  Square(const Height& height, bool faulted) {
    cut.mesh = test::flatGrid(20, 1.0);
    for (Vector3& v : cut.mesh.vertices)
      v.z() = height(v.x(), v.y());
    cut.vertex_faults.assign(cut.mesh.vertices.size(), {-1, -1});
    nodes = detail::krigingNodes(cut, VertexCorners(cut.mesh), 0.0);
    TriangleMesh wall;
    wall.vertices = {{0.5, -30.0, -30.0}, {0.5, 30.0, -30.0}, {0.5, 30.0, 30.0}, {0.5, -30.0, 30.0}};
    wall.triangles = {{0, 1, 2}, {0, 2, 3}};
    if (faulted)
      faults = FaultNetwork(std::vector<FaultSurface>{FaultSurface::fromMesh("wall", wall)});
  }
  std::vector<KrigedRow> rows(Correlation correlation) const {
    std::vector<Index> active(nodes.count());
    std::iota(active.begin(), active.end(), 0);
    detail::KrigedPlaces places;
    for (const Index v : nodes.vertex)
      places.place.push_back(cut.mesh.vertices[static_cast<std::size_t>(v)]);
    places.normal.assign(nodes.count(), Vector3::UnitZ());
    places.sight = places.place;
    return KrigedRows(places, faults, active, {}).rows({correlation, 5.0, 0.0});
  }
};

/// The largest height that is off what is expected, of nodes that enough others tell.
double mostOff(const std::vector<KrigedRow>& rows) {
  double most = 0.0;
  for (const KrigedRow& row : rows)
    if (row.variance < 0.5)
      most = std::max(most, std::abs(row.height));
  return most;
}

TEST(KrigedRows, APlaneIsExpected) {
  const Square square([](double x, double y) { return 3.0 + 0.2 * x - 0.3 * y; }, false);
  EXPECT_LT(mostOff(square.rows(Correlation::Gaussian)), 0.05);
  EXPECT_LT(mostOff(square.rows(Correlation::Matern3over2)), 0.05);
}

TEST(KrigedRows, AStepIsExpectedAtAFaultAlone) {
  const auto step = [](double x, double) { return x > 0.5 ? 5.0 : 0.0; };
  EXPECT_LT(mostOff(Square(step, true).rows(Correlation::Gaussian)), 0.05);
  EXPECT_GT(mostOff(Square(step, false).rows(Correlation::Gaussian)), 1.0);
}

TEST(KrigedRows, ASmootherCorrelationIsSurerOfWhatLiesBetween) {
  const Square square([](double, double) { return 0.0; }, false);
  const auto least = [&](Correlation correlation) {
    double variance = 1e9;
    for (const KrigedRow& row : square.rows(correlation))
      variance = std::min(variance, row.variance);
    return variance;
  };
  EXPECT_LT(least(Correlation::Gaussian), 0.1 * least(Correlation::Matern5over2));
  EXPECT_LT(least(Correlation::Matern5over2), 0.5 * least(Correlation::Matern3over2));
}

} // namespace
} // namespace graben
