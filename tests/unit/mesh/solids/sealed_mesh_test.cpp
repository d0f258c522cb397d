#include "graben/mesh/sealed_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace graben {
namespace {

/// Two unit cubes on one another: 0 below, 1 above, with a common square; each other side of a cube is a patch of its own.
SealedMesh twoCubes() {
  SealedMesh mesh;
  for (const double z : {0.0, 1.0, 2.0})
    for (const auto& xy : {std::array<double, 2>{0, 0}, std::array<double, 2>{1, 0}, std::array<double, 2>{1, 1}, std::array<double, 2>{0, 1}})
      mesh.vertices.emplace_back(xy[0], xy[1], z);
  mesh.surfaces = {{"wall", SealedSurfaceKind::Wall}, {"H", SealedSurfaceKind::Horizon}};
  mesh.blocks.resize(2);
  mesh.blocks[0].name = "lower";
  mesh.blocks[1].name = "upper";
  mesh.blocks[0].volume = mesh.blocks[1].volume = 1.0;
  const auto square = [&mesh](Index a, Index b, Index c, Index d, Index surface, Index behind, Index in_front) {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
    mesh.triangle_patch.insert(mesh.triangle_patch.end(), 2, static_cast<Index>(mesh.patches.size()));
    mesh.patches.push_back({surface, behind, in_front});
  };
  square(0, 3, 2, 1, 0, 0, -1);
  square(4, 5, 6, 7, 1, 0, 1);
  square(8, 9, 10, 11, 0, 1, -1);
  for (Index layer = 0; layer < 2; ++layer)
    for (Index i = 0; i < 4; ++i) {
      const Index a = 4 * layer + i, b = 4 * layer + (i + 1) % 4;
      square(a, b, b + 4, a + 4, 0, layer, -1);
    }
  return mesh;
}

TEST(SealedMesh, GivesClosedOutwardBlocks) {
  const SealedMesh mesh = twoCubes();
  for (Index block = 0; block < 2; ++block) {
    const TriangleMesh surface = blockSurface(mesh, block);
    EXPECT_EQ(surface.triangles.size(), 12U);
    EXPECT_EQ(surface.vertices.size(), 8U);
    EXPECT_DOUBLE_EQ(enclosedVolume(surface.vertices, surface.triangles), 1.0);
  }
  EXPECT_EQ(patchesOf(mesh, 1).triangles.size(), 2U);
}

TEST(SealedMesh, HasALineAlongEachEdgeBetweenPatches) {
  const auto lines = sealedLines(twoCubes());
  EXPECT_EQ(lines.size(), 20U); // 12 edges of a cube twice, but for four that both have
  for (const auto& line : lines)
    EXPECT_EQ(line.size(), 2U);
}

TEST(CheckSealed, PassesWhatIsClosed) {
  const SealedCheck check = checkSealed(twoCubes());
  EXPECT_TRUE(check.good()) << check.defects.front().what;
  EXPECT_DOUBLE_EQ(check.volume_of_box, 2.0);
}

bool says(const SealedCheck& check, const std::string& what) {
  return std::any_of(check.defects.begin(), check.defects.end(), [&](const SealedDefect& d) { return d.what.find(what) != std::string::npos; });
}

TEST(CheckSealed, FindsAHole) {
  SealedMesh mesh = twoCubes();
  mesh.triangles.pop_back();
  mesh.triangle_patch.pop_back();
  EXPECT_TRUE(says(checkSealed(mesh), "upper is open"));
  EXPECT_FALSE(says(checkSealed(mesh), "lower is open"));
}

TEST(CheckSealed, FindsATriangleTurnedRound) {
  SealedMesh mesh = twoCubes();
  std::swap(mesh.triangles.back()[0], mesh.triangles.back()[1]);
  EXPECT_TRUE(says(checkSealed(mesh), "is open"));
}

TEST(CheckSealed, FindsAnIntersection) {
  SealedMesh mesh = twoCubes();
  mesh.vertices[4] = Vector3(0.9, 0.9, 2.5); // a corner of the common square, pulled out through the top
  EXPECT_TRUE(says(checkSealed(mesh), "intersects"));
}

TEST(CheckSealed, FindsADegenerateTriangle) {
  SealedMesh mesh = twoCubes();
  mesh.vertices[8] = mesh.vertices[9];
  EXPECT_TRUE(says(checkSealed(mesh), "no area"));
}

TEST(CheckSealed, FindsVolumesThatDoNotAddUp) {
  SealedMesh mesh = twoCubes();
  mesh.blocks[0].volume *= 1.0 + 1e-11;
  EXPECT_TRUE(says(checkSealed(mesh), "add up"));
  mesh.blocks[0].volume = -1.0;
  EXPECT_TRUE(says(checkSealed(mesh), "lower is not positive"));
}

} // namespace
} // namespace graben
