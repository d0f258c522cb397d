#include "graben/surface/data_border.h"

#include "graben/mesh/triangle_bvh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace graben {
namespace {

/// Picks at random on a gentle wave over a square of 40 x 40, one a unit of area.
struct Wave {
  Points picks;
  TangentPlanes planes;
  FaultNetwork faults;
  NeighborGrid grid;

  Wave() {
    std::mt19937_64 random(7);
    const auto uniform = [&random] { return static_cast<double>(random() >> 11) / 9007199254740992.0; };
    for (int i = 0; i < 1600; ++i) {
      const double x = 40.0 * uniform();
      const double y = 40.0 * uniform();
      picks.emplace_back(x, y, std::sin(0.1 * x));
      planes.normals.push_back(Vector3(-0.1 * std::cos(0.1 * x), 0.0, 1.0).normalized());
    }
    planes.centres = picks;
    grid = NeighborGrid(picks);
  }

  SheetMesh sheets(double trimmed) const {
    SignedDistanceOptions o;
    o.rho_plus_delta = 3.5;
    o.overhang = 1.5;
    o.blend = 4;
    const SignedDistance field(grid, planes, faults, o);
    ExtractionOptions extraction;
    extraction.snap = 0.3;
    SheetMesh mesh = extractSheets(field, extraction);
    if (trimmed > 0.0)
      trimToData(mesh, field, {trimmed, 0});
    removeUnreferencedVertices(mesh.mesh);
    return mesh;
  }

  /// The largest distance of a vertex outside the square from it.
  static double overhang(const TriangleMesh& mesh) {
    double most = 0.0;
    for (const Vector3& p : mesh.vertices)
      most = std::max({most, -p.x(), -p.y(), p.x() - 40.0, p.y() - 40.0});
    return most;
  }
};

TEST(DataBorder, EndsNearTheOutermostPicksAndLosesNone) {
  const Wave wave;
  const SheetMesh whole = wave.sheets(0.0);
  const SheetMesh trimmed = wave.sheets(0.6);
  EXPECT_GT(Wave::overhang(whole.mesh), 0.8) << "whole cells reach far out";
  EXPECT_LT(Wave::overhang(trimmed.mesh), 0.75);
  EXPECT_EQ(trimmed.home.size(), trimmed.mesh.triangles.size());
  const TriangleBvh surface(trimmed.mesh);
  for (const Vector3& pick : wave.picks)
    EXPECT_LT(surface.nearest(pick).distance, 0.5);
}

TEST(DataBorder, InnerPartsStayAsTheyAre) {
  const Wave wave;
  const TriangleBvh surface(wave.sheets(0.6).mesh);
  for (double x = 3.0; x < 37.5; x += 0.5)
    for (double y = 3.0; y < 37.5; y += 0.5)
      EXPECT_LT(surface.nearest({x, y, std::sin(0.1 * x)}).distance, 0.2);
}

} // namespace
} // namespace graben
