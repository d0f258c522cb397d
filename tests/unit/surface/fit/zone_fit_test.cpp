#include "shapes.h"

#include "graben/analysis/approximation_error.h"
#include "graben/surface/fault_cut.h"
#include "graben/surface/zone_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace graben {
namespace {

/// A block on each side of a fault, and a mesh that smears the throw over three cells, cut along
/// the fault.
struct Smeared {
  FaultNetwork faults{{test::dippingFault(-40.0, 40.0, 15.0)}};
  test::Oriented picks;
  CutMesh cut;
  TangentPlanes planes;
  NeighborGrid grid;
  ZoneFitOptions options;

  static double truth(double x, double y, double block) {
    return block + 0.2 * std::sin(0.3 * y) + 0.03 * x;
  }

  Smeared() {
    const test::Oriented all =
        test::sheet(18.0, 0.5, [](double x, double y) { return truth(x, y, 0.0); });
    for (std::size_t i = 0; i < all.points.size(); ++i)
      for (const double block : {1.0, -1.0}) {
        const Vector3 p = all.points[i] + Vector3(0.0, 0.0, block);
        if ((block > 0.0) == (p.x() < p.z() / std::tan(test::kPi / 3.0)))
          picks.add(p, all.normals[i]);
      }
    TriangleMesh mesh = test::flatGrid(36, 1.03);
    for (Vector3& v : mesh.vertices)
      v.z() = truth(v.x(), v.y(), std::clamp(-v.x() / 1.5, -1.0, 1.0));
    cut = cutAlongFaults(mesh, faults, {});
    planes = picks.planes();
    grid = NeighborGrid(picks.points);
    options.zone_width = 5.0;
    options.max_step = 1.0;
  }
  ZoneFitResult fit() { return fitZone(cut, grid, planes, faults, options); }
  double error() const {
    return approximationError(cut.mesh, picks.points, zonePicks(picks.points, faults, 3.0))
        .mean_square;
  }
};

TEST(ZoneFit, LowersTheErrorAndKeepsBorderVerticesOnTheFault) {
  Smeared s;
  const double before = s.error();
  const ZoneFitResult result = s.fit();
  EXPECT_GT(result.fitted, 300U);
  EXPECT_LT(s.error(), 0.02 * before);
  std::size_t sealed = 0;
  for (std::size_t v = 0; v < s.cut.mesh.vertices.size(); ++v) {
    if (!s.cut.onFault(static_cast<Index>(v)))
      continue;
    ++sealed;
    EXPECT_LT(s.faults.nearest(s.cut.mesh.vertices[v]).distance, 1e-9);
  }
  EXPECT_GT(sealed, 70U);
}

TEST(ZoneFit, NormalModeMovesVerticesAlongTheirNormalsWhereNoBorderDrawsThem) {
  Smeared s;
  s.options.mode = FitMode::Normal;
  s.options.passes = 1;
  const double before = s.error();
  CutMesh start = s.cut;
  s.fit();
  EXPECT_LT(s.error(), 0.5 * before);
  const Points& normals = s.cut.mesh.normals; // those the pass began with
  ASSERT_EQ(normals.size(), start.mesh.vertices.size());
  for (std::size_t v = 0; v < normals.size(); ++v)
    if (s.faults.nearest(start.mesh.vertices[v]).distance > 3.5) {
      const Vector3 step = s.cut.mesh.vertices[v] - start.mesh.vertices[v];
      EXPECT_LT(step.cross(normals[v]).norm(), 1e-9);
    }
}

TEST(ZoneFit, OffZoneAndFarVerticesStay) {
  Smeared s;
  const Points before = s.cut.mesh.vertices;
  s.options.mode = FitMode::Off;
  EXPECT_EQ(s.fit().fitted, 0U);
  EXPECT_EQ(s.cut.mesh.vertices, before);
  s.options.mode = FitMode::Full;
  s.fit();
  for (std::size_t v = 0; v < before.size(); ++v)
    if (s.faults.nearest(before[v]).distance > 5.0) {
      ASSERT_EQ(s.cut.mesh.vertices[v], before[v]);
    }
}

TEST(ZoneFit, VerticesWithoutPicksOfTheirSideAreCountedAndStay) {
  Smeared s;
  s.options.search_radius = 1e-3;
  const Points before = s.cut.mesh.vertices;
  const ZoneFitResult result = s.fit();
  EXPECT_EQ(result.fitted, 0U);
  EXPECT_GT(result.without_picks, 300U);
  EXPECT_EQ(s.cut.mesh.vertices, before);
}

TEST(ZoneFit, ACreaseIsFoundWhereTheZoneIsEverything) {
  // A roof with its ridge at x = 0; the mesh cuts the ridge off.
  test::Oriented picks;
  const test::Oriented all = test::sheet(6.0, 0.4, [](double, double) { return 0.0; });
  for (const Vector3& p : all.points)
    if (std::abs(p.x()) > 0.05)
      picks.add({p.x(), p.y(), -std::abs(p.x())}, {p.x() > 0.0 ? 1.0 : -1.0, 0.0, 1.0});
  CutMesh cut;
  cut.mesh = test::flatGrid(10, 1.0);
  for (Vector3& v : cut.mesh.vertices)
    v.z() = -std::max(0.5, std::abs(v.x()));
  cut.vertex_faults.assign(cut.mesh.vertices.size(), {-1, -1});
  ZoneFitOptions options;
  options.zone_width = std::numeric_limits<double>::infinity();
  const TangentPlanes planes = picks.planes();
  fitZone(cut, NeighborGrid(picks.points), planes, FaultNetwork(), options);
  std::size_t ridge = 0;
  for (const Vector3& v : cut.mesh.vertices)
    if (std::abs(v.x()) < 0.3) {
      ++ridge;
      EXPECT_NEAR(v.x(), 0.0, 1e-5);
      EXPECT_NEAR(v.z(), 0.0, 1e-5);
    }
  EXPECT_EQ(ridge, 11U);
}

TEST(ZoneFit, ThreadsMakeNoDifference) {
  Smeared one, four;
  one.options.threads = 1;
  four.options.threads = 4;
  one.fit();
  four.fit();
  EXPECT_TRUE(test::sameMesh(one.cut.mesh, four.cut.mesh));
}

} // namespace
} // namespace graben
