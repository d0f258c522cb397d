#include "graben/model/block_model.h"

#include "graben/core/errors.h"

#include <gtest/gtest.h>

#include "support/stacks.h"

#include <algorithm>
#include <cmath>

namespace graben {
namespace {

using test::planeFault;
using test::smallBox;
using test::surfaceOver;

StackHorizon horizon(const std::string& name, const std::function<double(double, double)>& height) { return {name, surfaceOver(260.0, 26, height)}; }

void expectClosed(const BlockModel& model) {
  const SealedCheck check = checkSealed(model.sealed);
  EXPECT_TRUE(check.good()) << check.defects.front().what;
}

double volumeOf(const BlockModel& model, const std::string& name) {
  for (const SealedBlock& block : model.sealed.blocks)
    if (block.name == name)
      return block.volume;
  ADD_FAILURE() << "there is no block " << name;
  return 0.0;
}

TEST(BlockModel, LayersOfFlatHorizonsAreExact) {
  const BlockModel model = buildBlockModel({horizon("A", [](double, double) { return 30.0; }), horizon("B", [](double, double) { return -41.0; })},
                                           FaultNetwork(), smallBox());
  expectClosed(model);
  ASSERT_EQ(model.sealed.blocks.size(), 3U);
  EXPECT_NEAR(volumeOf(model, "above_A"), 400.0 * 400.0 * 120.0, 1.0);
  EXPECT_NEAR(volumeOf(model, "A-B"), 400.0 * 400.0 * 71.0, 1.0);
  EXPECT_NEAR(volumeOf(model, "below_B"), 400.0 * 400.0 * 109.0, 1.0);
}

/// Two sides of a fault that dips 60 degrees to the east, each with its own level.
TEST(BlockModel, AFaultThroughTheBoxPartsEveryLayer) {
  const double dip = std::tan(60.0 * 3.14159265358979 / 180.0);
  for (const double throw_ : {60.0, -60.0, 3.0}) {
    const auto step = [&](double level) {
      TriangleMesh whole;
      for (const int side : {-1, 1}) {
        const double z = level - (side > 0 ? throw_ : 0.0);
        TriangleMesh part = surfaceOver(260.0, 26, [z](double, double) { return z; });
        for (Vector3& p : part.vertices) { // each wall to the fault, at x = -z / dip
          const double edge = -z / dip;
          p.x() = side > 0 ? edge + (p.x() + 260.0) * (260.0 - edge) / 520.0 : -260.0 + (p.x() + 260.0) * (edge + 260.0) / 520.0;
        }
        append(whole, part);
      }
      return whole;
    };
    const FaultNetwork faults({planeFault("F", Vector3::Zero(), {0, 1}, dip, -260.0, 260.0)});
    const BlockModel model = buildBlockModel({{"A", step(50.0)}, {"B", step(0.0)}}, faults, smallBox());
    expectClosed(model);
    ASSERT_EQ(model.sealed.blocks.size(), 6U) << throw_;
    EXPECT_NEAR(volumeOf(model, "A-B_F-"), 400.0 * 50.0 * (200.0 - 25.0 / dip), 2e-4 * 400 * 50 * 200) << throw_;
    EXPECT_NEAR(volumeOf(model, "A-B_F+"), 400.0 * 50.0 * (200.0 + (25.0 - throw_) / dip), 2e-4 * 400 * 50 * 200) << throw_;
  }
}

/// The fault ends at y = 0: the layers stay one round its tip, the fault is an internal surface.
TEST(BlockModel, ATipStaysInsideItsBlock) {
  const auto drop = [](double y) { return y >= 0.0 ? 0.0 : -40.0 * std::min(1.0, -y / 150.0); };
  TriangleMesh mesh = surfaceOver(260.0, 52, [&](double x, double y) { return x > 0.0 ? drop(y) : 0.0; });
  TriangleMesh cut; // vertical fault at x = 0: triangles across it are made of two walls
  cut.vertices = mesh.vertices;
  for (const Triangle& t : mesh.triangles) {
    Triangle own = t;
    double x = 0.0, y = 0.0;
    for (const Index v : t) {
      x += mesh.vertices[static_cast<std::size_t>(v)].x();
      y = std::min(y, mesh.vertices[static_cast<std::size_t>(v)].y());
    }
    if (x > 0.0 && y < 0.0)
      for (Index& v : own)
        if (std::abs(mesh.vertices[static_cast<std::size_t>(v)].x()) < 1e-9 && mesh.vertices[static_cast<std::size_t>(v)].y() < 0.0) {
          cut.vertices.push_back(mesh.vertices[static_cast<std::size_t>(v)]);
          cut.vertices.back().z() = drop(cut.vertices.back().y());
          v = static_cast<Index>(cut.vertices.size() - 1);
        }
    cut.triangles.push_back(own);
  }
  const FaultNetwork faults({planeFault("F", Vector3::Zero(), {0, 1}, 1e9, -260.0, 0.0)});
  const BlockModel model = buildBlockModel({{"A", cut}}, faults, smallBox(10.0));
  expectClosed(model);
  ASSERT_EQ(model.sealed.blocks.size(), 2U);
  EXPECT_EQ(model.sealed.blocks[0].fault_side[0], 2);
  const bool internal = std::any_of(model.sealed.patches.begin(), model.sealed.patches.end(),
                                    [](const SealedPatch& p) { return p.behind == p.in_front; });
  EXPECT_TRUE(internal);
  // the dropped part: 200 wide, falling off linearly over 150, then constant over 50
  EXPECT_NEAR(volumeOf(model, "below_A"), 400.0 * 400.0 * 150.0 - 200.0 * 40.0 * (75.0 + 50.0), 2e-4 * 400 * 400 * 150);
}

/// A Y and an X of vertical faults under one flat horizon.
TEST(BlockModel, FaultsThatBranchAndCross) {
  const FaultSurface main = planeFault("M", Vector3::Zero(), {0, 1}, 1e9, -260.0, 260.0);
  const BlockModel y = buildBlockModel({horizon("A", [](double, double) { return 7.0; })},
                                       FaultNetwork({main, planeFault("B", Vector3::Zero(), {1, 0}, 1e9, 4.0, 260.0)}, 20.0), smallBox());
  expectClosed(y);
  EXPECT_EQ(y.sealed.blocks.size(), 6U);
  const BlockModel x = buildBlockModel({horizon("A", [](double, double) { return 7.0; })},
                                       FaultNetwork({main, planeFault("C", Vector3::Zero(), {1, 0}, 1e9, -260.0, 260.0)}, 20.0), smallBox());
  expectClosed(x);
  ASSERT_EQ(x.sealed.blocks.size(), 8U);
  for (const SealedBlock& block : x.sealed.blocks)
    EXPECT_NEAR(block.volume, 200.0 * 200.0 * (block.layer == 0 ? 143.0 : 157.0), 1.0);
}

/// Thickness falls from 40 to -20 over the box: absent where thinner than 4.
TEST(BlockModel, ALayerPinchesOut) {
  BlockModelOptions o = smallBox();
  o.min_thickness = 4.0;
  std::vector<StackHorizon> stack = {horizon("A", [](double, double) { return 20.0; }),
                                     horizon("B", [](double x, double) { return 20.0 - (10.0 - 0.15 * x); })};
  stack[0].relation = HorizonRelation::Erosional;
  const BlockModel model = buildBlockModel(stack, FaultNetwork(), o);
  expectClosed(model);
  ASSERT_EQ(model.sealed.blocks.size(), 3U);
  double farthest = -1e9;
  for (std::size_t b = 0; b < 3; ++b)
    if (model.sealed.blocks[b].name == "A-B")
      for (const Vector3& p : blockSurface(model.sealed, static_cast<Index>(b)).vertices)
        farthest = std::max(farthest, p.x());
  EXPECT_NEAR(farthest, 40.0, 2.0 * o.size) << "thickness is 4 at x = 40";
}

TEST(BlockModel, AConformableHorizonAboveTheOneOverItIsRefused) {
  try {
    const StackHorizon lower = horizon("B", [](double x, double) { return -10.0 + 0.2 * x; });
    buildBlockModel({horizon("A", [](double, double) { return 0.0; }), lower}, FaultNetwork(), smallBox());
    FAIL() << "crossed horizons were taken";
  } catch (const InvalidInputError& error) {
    EXPECT_NE(std::string(error.what()).find("B lies above A by up to"), std::string::npos) << error.what();
  }
}

TEST(BlockModel, TrianglesAreWellShaped) {
  const FaultNetwork faults({planeFault("F", Vector3::Zero(), {0.6, 0.8}, 2.0, -400.0, 400.0), planeFault("G", Vector3(60, 0, 0), {0, 1}, 3.0, -30.0, 400.0)});
  const BlockModel model = buildBlockModel({horizon("A", [](double x, double y) { return 20.0 * std::sin(x / 60.0) * std::cos(y / 50.0); }),
                                            horizon("B", [](double x, double y) { return 20.0 * std::sin(x / 60.0) * std::cos(y / 50.0) - 33.0; })},
                                           faults, smallBox(10.0));
  expectClosed(model);
  std::size_t slivers = 0;
  double smallest = 4.0;
  for (const Triangle& t : model.sealed.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto p = [&](std::size_t k) -> const Vector3& { return model.sealed.vertices[static_cast<std::size_t>(t[(i + k) % 3])]; };
      const Vector3 a = (p(1) - p(0)).normalized(), b = (p(2) - p(0)).normalized();
      const double angle = std::acos(std::min(1.0, a.dot(b)));
      smallest = std::min(smallest, angle);
      slivers += angle < 10.0 * 3.14159265 / 180.0 ? 1 : 0;
    }
  EXPECT_LT(static_cast<double>(slivers), 0.02 * static_cast<double>(model.sealed.triangles.size()));
  EXPECT_GT(smallest, 0.2 * 3.14159265 / 180.0);
}

TEST(BlockModel, HolesAndRimsAreCarriedOn) {
  TriangleMesh mesh = surfaceOver(150.0, 30, [](double x, double y) { return 0.2 * x - 0.1 * y; });
  std::vector<Triangle> kept;
  for (const Triangle& t : mesh.triangles)
    if (mesh.vertices[static_cast<std::size_t>(t[0])].norm() > 50.0)
      kept.push_back(t);
  mesh.triangles = kept;
  const BlockModel model = buildBlockModel({{"A", mesh}}, FaultNetwork(), smallBox());
  expectClosed(model);
  ASSERT_EQ(model.sealed.blocks.size(), 2U);
  EXPECT_NEAR(model.sealed.blocks[0].volume, 400.0 * 400.0 * 150.0, 1e-3 * 400 * 400 * 150) << "the plane was carried on";
  const double carried_on = 1.0 - (300.0 * 300.0 - 3.14 * 50.0 * 50.0) / 160000.0;
  EXPECT_LT(model.horizons[0].extrapolated_share, carried_on) << "what lies within a triangle's edge does not count";
  EXPECT_GT(model.horizons[0].extrapolated_share, 0.6 * carried_on);
}

TEST(BlockModel, HorizonsOutsideTheBoxAreRefused) {
  TriangleMesh mesh = surfaceOver(50.0, 5, [](double, double) { return 0.0; });
  for (Vector3& p : mesh.vertices)
    p.x() += 1000.0;
  EXPECT_THROW(buildBlockModel({{"A", mesh}}, FaultNetwork(), smallBox()), InvalidInputError);
  EXPECT_THROW(buildBlockModel({}, FaultNetwork(), smallBox()), InvalidInputError);
}

TEST(BlockModel, IsTheSameForAnyNumberOfThreads) {
  const auto build = [](unsigned threads) {
    BlockModelOptions o = smallBox();
    o.threads = threads;
    const FaultNetwork faults({planeFault("F", Vector3::Zero(), {0.6, 0.8}, 2.0, -400.0, 400.0)});
    return buildBlockModel({horizon("A", [](double x, double y) { return 20.0 * std::sin(x / 60.0) * std::cos(y / 50.0); })}, faults, o).sealed;
  };
  const SealedMesh one = build(1), three = build(3);
  EXPECT_EQ(one.triangles, three.triangles);
  EXPECT_EQ(one.vertices, three.vertices);
}

} // namespace
} // namespace graben
