#include "unit/pipeline/picked/judged.h"

#include "graben/core/errors.h"
#include "graben/mesh/normals.h"
#include "graben/surface/map_outline.h"

#include <limits>

namespace graben {
namespace {

constexpr double kAll = std::numeric_limits<double>::infinity();

SyntheticOptions smallHorizon(SyntheticKind kind) {
  SyntheticOptions o = SyntheticOptions::of(kind);
  o.size = 3000.0;
  o.relief = 30.0;
  o.noise = 0.5;
  o.picks = 10000;
  o.max_throw = 60.0;
  return o;
}

double mapArea(const TriangleMesh& mesh) {
  double area = 0.0;
  for (const Triangle& t : mesh.triangles)
    area += std::abs(areaNormal(mesh, t).z()) / 2.0;
  return area;
}

TEST(Extent, AHoleThatAFaultCrossesIsCoveredOnBothSides) {
  SyntheticOptions o = smallHorizon(SyntheticKind::Normal);
  o.holes = {{0.0, 0.0, 350.0}};
  const SyntheticModel model(o);
  ReconstructionOptions options;
  options.fill_holes = kAll;
  const test::Judged judged = test::judge(model, model.picks().points, 400.0, options);
  test::expectRight(judged, model, {1.5, 3.0, 4.0});
  EXPECT_GE(judged.result.report.extent.holes, 1U);
  EXPECT_EQ(judged.result.report.topology.border_loops, 2U);
}

TEST(Extent, HolesWiderThanAskedForStayOpen) {
  SyntheticOptions o = smallHorizon(SyntheticKind::Unfaulted);
  o.holes = {{-600.0, 0.0, 200.0}, {600.0, 0.0, 400.0}};
  const SyntheticModel model(o);
  ReconstructionOptions options;
  options.fill_holes = 600.0;
  const ReconstructionResult result = HorizonReconstruction(options).reconstruct(model.picks().points);
  EXPECT_EQ(result.report.extent.holes, 1U);
  EXPECT_EQ(result.report.extent.open, 1U);
  EXPECT_NEAR(result.report.extent.widest_open, 800.0, 80.0);
  EXPECT_EQ(result.report.topology.border_loops, 2U);
}

TEST(Extent, TheHullIsCoveredWholeAndNothingBeyond) {
  SyntheticOptions o = smallHorizon(SyntheticKind::Normal);
  o.holes = {{1500.0, 0.0, 700.0}, {-400.0, 900.0, 300.0}}; // a bay at the edge, and a hole
  const SyntheticModel model(o);
  ReconstructionOptions options;
  options.extent = HorizonExtent::Hull;
  const test::Judged judged = test::judge(model, model.picks().points, 750.0, options);
  test::expectRight(judged, model, {3.0, 3.0, 4.0});
  const MapOutline hull = MapOutline::hullOf(model.picks().points);
  for (const Vector3& v : judged.result.mesh.vertices)
    EXPECT_LT(hull.beyond(v), 1.2 * judged.result.report.used.voxel_size);
  EXPECT_EQ(judged.result.report.topology.border_loops, 2U);
}

TEST(Extent, APolygonIsCoveredWholeBeyondThePicksAndCutsThemOff) {
  const SyntheticModel model(smallHorizon(SyntheticKind::Unfaulted));
  ReconstructionOptions options;
  options.extent = HorizonExtent::Polygon;
  options.polygon = {{{-1000.0, -1000.0, 0.0}, {1900.0, -1000.0, 0.0}, {1900.0, 1000.0, 0.0}, {-1000.0, 1000.0, 0.0}}};
  const ReconstructionResult result = HorizonReconstruction(options).reconstruct(model.picks().points);
  EXPECT_NEAR(mapArea(result.mesh), 2900.0 * 2000.0, 0.03 * 2900.0 * 2000.0);
  EXPECT_EQ(result.report.topology.border_loops, 1U);
  EXPECT_NEAR(result.report.extent.farthest, 400.0, 100.0);
  double marked = 0.0;
  const std::vector<float>& beyond = result.mesh.scalars.at("extrapolated");
  for (std::size_t v = 0; v < beyond.size(); ++v)
    marked = std::max(marked, result.mesh.vertices[v].x() > 1700.0 ? static_cast<double>(1.0F - beyond[v]) : 0.0);
  EXPECT_EQ(marked, 0.0) << "all beyond the picks is marked as extrapolated";
}

TEST(Extent, AsksForAPolygonWithAnArea) {
  ReconstructionOptions options;
  options.extent = HorizonExtent::Polygon;
  options.polygon = {{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}}};
  EXPECT_THROW(HorizonReconstruction(options).reconstruct({}), InvalidInputError);
  options = {};
  options.fill_holes = -1.0;
  EXPECT_THROW(HorizonReconstruction(options).reconstruct({}), InvalidInputError);
}

} // namespace
} // namespace graben
