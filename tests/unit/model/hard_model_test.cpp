#include "graben/model/block_model.h"

#include "graben/core/errors.h"

#include <gtest/gtest.h>

#include "support/random_stack.h"

#include <cmath>

namespace graben {
namespace {

using test::planeFault;
using test::smallBox;
using test::surfaceOver;

StackHorizon horizon(const std::string& name, const std::function<double(double, double)>& height) { return {name, surfaceOver(260.0, 26, height)}; }

StackHorizon wavy(const std::string& name, double level) {
  return horizon(name, [level](double x, double y) { return level + 15.0 * std::sin(x / 70.0) * std::cos(y / 60.0); });
}

BlockModel expectClosed(const std::vector<StackHorizon>& horizons, const std::vector<FaultSurface>& faults, const BlockModelOptions& options) {
  BlockModel model = buildBlockModel(horizons, FaultNetwork(faults, 20.0), options);
  const SealedCheck check = checkSealed(model.sealed);
  EXPECT_TRUE(check.good()) << check.defects.front().what;
  return model;
}

TEST(HardModel, AFaultAlongTheOutline) {
  expectClosed({wavy("A", 0.0)}, {planeFault("F", Vector3(200, 0, 0), {0, 1}, 1e9, -260, 260)}, smallBox());
  expectClosed({wavy("A", 0.0)}, {planeFault("F", Vector3(199.98, 0, 0), {0, 1}, 1e9, -260, 260)}, smallBox());
}

TEST(HardModel, TwoFaultsATenthOfASizeApart) {
  const BlockModel model = expectClosed(
    {wavy("A", 0.0)}, {planeFault("F", Vector3(1, 0, 0), {0, 1}, 3.0, -260, 260), planeFault("G", Vector3(3, 0, 0), {0, 1}, 3.0, -260, 260)}, smallBox());
  EXPECT_GE(model.sealed.blocks.size(), 4U);
}

TEST(HardModel, AHorizonThatTouchesTheBaseAndTheTop) {
  expectClosed({horizon("A", [](double x, double) { return 150.0 + 0.05 * x; }), horizon("B", [](double, double y) { return -150.0 + 0.1 * std::abs(y); })}, {},
               smallBox());
  expectClosed({horizon("A", [](double, double) { return 150.0; }), horizon("B", [](double, double) { return -150.0; })}, {}, smallBox());
}

TEST(HardModel, AFaultBesideAHorizonsBorder) {
  TriangleMesh mesh = surfaceOver(260.0, 26, [](double x, double) { return 0.05 * x; });
  std::vector<Triangle> kept;
  for (const Triangle& t : mesh.triangles)
    if (std::max({mesh.vertices[static_cast<std::size_t>(t[0])].x(), mesh.vertices[static_cast<std::size_t>(t[1])].x(),
                  mesh.vertices[static_cast<std::size_t>(t[2])].x()}) <= 0.01)
      kept.push_back(t);
  mesh.triangles = kept;
  expectClosed({{"A", mesh}}, {planeFault("F", Vector3(0.02, 0, 0), {0, 1}, 1e9, -260, 260)}, smallBox());
}

TEST(HardModel, TwentyFaultsAndTenHorizons) {
  std::vector<FaultSurface> faults;
  for (int i = 0; i < 20; ++i)
    faults.push_back(planeFault("F" + std::to_string(i), Vector3(-190.0 + 20.0 * i, 0, 0), {0.1, 0.995}, i % 2 == 0 ? 2.5 : -2.5, -150.0 + 10.0 * i, 100.0));
  expectClosed({wavy("A", 0.0)}, faults, smallBox());
  std::vector<StackHorizon> horizons;
  for (int k = 0; k < 10; ++k)
    horizons.push_back(wavy("H" + std::to_string(k), 100.0 - 22.0 * k));
  const BlockModel model = expectClosed(horizons, {faults[10]}, smallBox());
  EXPECT_GE(model.sealed.blocks.size(), 11U);
}

TEST(HardModel, AFoldedFault) {
  TriangleMesh mesh = surfaceOver(260.0, 40, [](double, double) { return 0.0; });
  for (Vector3& p : mesh.vertices) { // upright, with a fold that hangs over
    const double up = p.y();
    p = Vector3(60.0 * std::sin(up / 50.0) + 0.2 * p.x() + 30.0 * std::sin(p.x() / 60.0), p.x(), up);
  }
  const BlockModel model = expectClosed({wavy("A", 40.0), wavy("B", -30.0)}, {FaultSurface::fromMesh("F", mesh)}, smallBox());
  EXPECT_GE(model.sealed.blocks.size(), 6U);
}

/// The first few of those that graben_random_stacks draws by lot.
TEST(HardModel, RandomStacksAreClosed) {
  constexpr std::uint64_t kSeeds = 12;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    SCOPED_TRACE(seed);
    const test::RandomStack stack = test::StackLottery(seed).draw();
    const BlockModel model = buildBlockModel(stack.horizons, FaultNetwork(stack.faults, stack.branch_reach), stack.options);
    const SealedCheck check = checkSealed(model.sealed);
    EXPECT_TRUE(check.good()) << check.defects.front().what;
  }
}

} // namespace
} // namespace graben
