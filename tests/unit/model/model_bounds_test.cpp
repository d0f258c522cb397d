#include "graben/model/block_model.h"

#include "graben/core/errors.h"

#include "support/stacks.h"

#include <gmock/gmock.h>

#include <cmath>

namespace graben {
namespace {

using test::planeFault;
using test::smallBox;
using test::surfaceOver;
using Corner = Eigen::Vector2d;

StackHorizon horizon(const std::string& name, const std::function<double(double, double)>& height) { return {name, surfaceOver(260.0, 26, height)}; }

StackHorizon level(const std::string& name, double z) {
  return horizon(name, [z](double, double) { return z; });
}

BlockModel closedModel(const std::vector<StackHorizon>& horizons, const BlockModelOptions& options, const std::vector<FaultSurface>& faults = {}) {
  BlockModel model = buildBlockModel(horizons, FaultNetwork(faults, 20.0), options);
  const SealedCheck check = checkSealed(model.sealed);
  EXPECT_TRUE(check.good()) << check.defects.front().what;
  return model;
}

double volumeOf(const BlockModel& model) {
  double volume = 0.0;
  for (const SealedBlock& block : model.sealed.blocks)
    volume += block.volume;
  return volume;
}

double areaOf(const BlockModel& model, const std::string& surface) {
  double area = 0.0;
  for (std::size_t t = 0; t < model.sealed.triangles.size(); ++t) {
    if (model.sealed.surfaces[static_cast<std::size_t>(model.sealed.patchOf(t).surface)].name != surface)
      continue;
    const auto p = [&](std::size_t i) -> const Vector3& { return model.sealed.vertices[static_cast<std::size_t>(model.sealed.triangles[t][i])]; };
    const Vector3 a = p(1) - p(0), b = p(2) - p(0);
    area += 0.5 * Vector3(a.y() * b.z() - a.z() * b.y(), a.z() * b.x() - a.x() * b.z(), a.x() * b.y() - a.y() * b.x()).norm();
  }
  return area;
}

TEST(ModelBounds, APolygonIsMetExactly) {
  BlockModelOptions o = smallBox();
  o.outline = {Corner(-170, -150), Corner(180, -190), Corner(150, 30), Corner(10, 20), Corner(-20, 185), Corner(-190, 100)}; // with a corner inward
  double area = 0.0, perimeter = 0.0;
  for (std::size_t i = 0; i < o.outline.size(); ++i) {
    const Corner &a = o.outline[i], &b = o.outline[(i + 1) % o.outline.size()];
    area += 0.5 * (a.x() * b.y() - a.y() * b.x());
    perimeter += (b - a).norm();
  }
  const BlockModel model = closedModel({level("A", 10.0)}, o, {planeFault("F", Vector3(-40, 0, 0), {0.1, 0.995}, 2.0, -300, 300)});
  EXPECT_EQ(model.sealed.blocks.size(), 4U);
  EXPECT_NEAR(volumeOf(model), 300.0 * area, 1e-6 * 300.0 * area);
  EXPECT_NEAR(areaOf(model, "outline"), 300.0 * perimeter, 1e-6 * 300.0 * perimeter);
  EXPECT_EQ(areaOf(model, "west"), 0.0);
}

TEST(ModelBounds, ATopographyCutsOffWhatReachesIt) {
  BlockModelOptions o = smallBox();
  o.top_is_first = true;
  o.top_name = "topography";
  const auto ground = [](double x, double y) { return 60.0 + 0.2 * x + 10.0 * std::sin(y / 60.0); };
  const BlockModel model = closedModel({horizon("topography", ground), level("A", 50.0), level("B", -60.0)}, o);
  EXPECT_EQ(model.sealed.blocks.size(), 3U);
  EXPECT_NEAR(volumeOf(model), 400.0 * 400.0 * 210.0, 2e-3 * 400.0 * 400.0 * 210.0);
  double over_a = 0.0; // where A lies under the ground
  for (double x = -199.0; x < 200.0; x += 2.0)
    for (double y = -199.0; y < 200.0; y += 2.0)
      over_a += 4.0 * std::max(0.0, ground(x, y) - 50.0);
  EXPECT_EQ(model.sealed.blocks[0].layer + model.sealed.blocks[1].layer + model.sealed.blocks[2].layer, 0 + 1 + 2);
  for (const SealedBlock& block : model.sealed.blocks)
    if (block.layer == 0) {
      EXPECT_NEAR(block.volume, over_a, 0.02 * over_a);
    }
  for (const SealedSurface& surface : model.sealed.surfaces)
    EXPECT_EQ(surface.name == "topography", surface.kind == SealedSurfaceKind::Top) << surface.name;
}

TEST(ModelBounds, HorizonsEndAtABaseSurface) {
  BlockModelOptions o = smallBox();
  o.base_is_last = true;
  o.base_name = "basement";
  const BlockModel model = closedModel({level("A", 0.0), horizon("basement", [](double x, double) { return 0.4 * x; })}, o);
  EXPECT_EQ(model.sealed.blocks.size(), 2U);
  EXPECT_NEAR(volumeOf(model), 400.0 * 400.0 * 150.0, 2e-3 * 400.0 * 400.0 * 150.0);
  EXPECT_NEAR(model.sealed.blocks[0].layer == 1 ? model.sealed.blocks[0].volume : model.sealed.blocks[1].volume, 400.0 * 200.0 * 40.0, 0.02 * 400 * 200 * 40);
  o.top_is_first = true;
  EXPECT_THROW(buildBlockModel({level("top", -100.0), level("A", 0.0), level("basement", 100.0)}, FaultNetwork(), o), InvalidInputError);
}

TEST(ModelBounds, WallsAreAsFineAsAsked) {
  BlockModelOptions o = smallBox(10.0);
  const auto longest = [](const BlockModel& model) {
    double most = 0.0;
    for (std::size_t t = 0; t < model.sealed.triangles.size(); ++t)
      for (std::size_t i = 0; i < 3; ++i)
        most = std::max(most, (model.sealed.vertices[static_cast<std::size_t>(model.sealed.triangles[t][i])] -
                               model.sealed.vertices[static_cast<std::size_t>(model.sealed.triangles[t][(i + 1) % 3])]).norm());
    return most;
  };
  EXPECT_GT(longest(closedModel({level("A", 0.0)}, o)), 60.0);
  o.wall_size = 25.0;
  EXPECT_LT(longest(closedModel({level("A", 0.0)}, o)), 3.0 * 25.0);
}

TEST(ModelBounds, AHoleBeyondTheFillIsNamed) {
  TriangleMesh mesh = surfaceOver(260.0, 52, [](double, double) { return 0.0; });
  std::vector<Triangle> kept;
  for (const Triangle& t : mesh.triangles)
    if ((mesh.vertices[static_cast<std::size_t>(t[0])] - Vector3(60, -40, 0)).norm() > 90.0)
      kept.push_back(t);
  mesh.triangles = kept;
  BlockModelOptions o = smallBox();
  o.fill = 40.0;
  try {
    buildBlockModel({{"A", mesh}}, FaultNetwork(), o);
    FAIL() << "the hole was filled";
  } catch (const InvalidInputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("horizon A"));
    EXPECT_THAT(error.what(), testing::HasSubstr("there is a hole about x "));
  }
  closedModel({{"A", mesh}, level("B", -50.0)}, o); // B is known there
  o.fill = 120.0;
  closedModel({{"A", mesh}}, o);
}

TEST(ModelBounds, TheShareOfAnAbsentLayerIsTold) {
  BlockModelOptions o = smallBox();
  o.min_thickness = 2.0;
  const BlockModel model = closedModel({level("A", 0.0), horizon("B", [](double x, double) { return std::min(0.0, -0.3 * x); })}, o); // absent in the west
  EXPECT_NEAR(model.horizons[1].absent_share, 0.5, 0.06);
  EXPECT_EQ(model.horizons[0].absent_share, 0.0);
}

} // namespace
} // namespace graben
