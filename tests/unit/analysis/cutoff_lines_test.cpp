#include "graben/analysis/cutoff_lines.h"

#include "graben/core/errors.h"

#include <gtest/gtest.h>

namespace graben {
namespace {

/// A strip of two squares along x; its upper border (y = 1) lies on fault 3.
TriangleMesh strip() {
  TriangleMesh mesh;
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 3; ++x)
      mesh.vertices.emplace_back(x, y, 0.0);
  mesh.triangles = {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}};
  mesh.piece.assign(6, 7);
  return mesh;
}

TEST(CutoffLines, FollowsTheBorderOnAFault) {
  const std::vector<std::array<Index, 2>> on = {{-1, -1}, {-1, -1}, {-1, -1}, {3, -1}, {3, -1}, {1, 3}};
  const auto lines = cutoffLines(strip(), on);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0].fault, 3);
  EXPECT_EQ(lines[0].piece, 7);
  ASSERT_EQ(lines[0].points.size(), 3U);
  EXPECT_EQ(lines[0].points.front(), Vector3(2, 1, 0)) << "the piece lies to the left";
  EXPECT_EQ(lines[0].points.back(), Vector3(0, 1, 0));
}

TEST(CutoffLines, SplitsWhereTheBorderLeavesTheFaultAndClosesLoops) {
  const std::vector<std::array<Index, 2>> gap = {{3, -1}, {3, -1}, {-1, -1}, {-1, -1}, {3, -1}, {3, -1}};
  EXPECT_EQ(cutoffLines(strip(), gap).size(), 2U);
  const std::vector<std::array<Index, 2>> all(6, {0, -1});
  const auto loop = cutoffLines(strip(), all);
  ASSERT_EQ(loop.size(), 1U);
  EXPECT_EQ(loop[0].points.front(), loop[0].points.back());
}

TEST(CutoffLines, RefusesALabelTooFew) {
  EXPECT_THROW(cutoffLines(strip(), {}), InvalidInputError);
}

} // namespace
} // namespace graben
