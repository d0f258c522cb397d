#include "graben/surface/crumbs.h"

#include "graben/mesh/components.h"
#include "unit/surface/cut_square.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace graben {
namespace {

using test::square;

std::vector<Index> trianglesAt(const CutMesh& cut, Index vertex) {
  std::vector<Index> found;
  for (const Index corner : VertexCorners(cut.mesh).of(static_cast<std::size_t>(vertex)))
    found.push_back(corner / 3);
  return found;
}

TEST(TriangleRemoval, LeavesNoFansTouchingInAVertex) {
  CutMesh cut = square(4);
  const VertexCorners corners(cut.mesh);
  cut.vertex_faults[12] = {7, -1};
  // Around the middle vertex (12) all but two opposite triangles go, in two goes.
  const std::vector<Index> around = trianglesAt(cut, 12);
  ASSERT_EQ(around.size(), 6U);
  TriangleRemoval removal(cut, corners);
  EXPECT_TRUE(removal.empty());
  EXPECT_EQ(removal.take({around[1], around[2]}), 2U);
  EXPECT_EQ(removal.take({around[3], around[4]}), 2U);
  EXPECT_EQ(cut.mesh.triangles.size(), 32U) << "they stay in their places until the end";
  const TriangleRemoval::Result result = removal.finish(1);
  EXPECT_EQ(cut.mesh.triangles.size(), 28U);
  EXPECT_EQ(cut.mesh.vertices.size(), 26U) << "the middle vertex is doubled";
  EXPECT_EQ(cut.vertex_faults.size(), 26U);
  EXPECT_EQ(cut.vertex_faults.back(), cut.vertex_faults[12]);
  EXPECT_EQ(trianglesAt(cut, 12).size(), 1U);
  EXPECT_EQ(trianglesAt(cut, 25).size(), 1U);
  EXPECT_EQ(connectedComponents(cut.mesh).triangle_count.size(), 1U);
  EXPECT_THAT(result.touched, testing::Contains(25));
  EXPECT_EQ(result.crumbs, 0U);
}

TEST(TriangleRemoval, WhatIsLeftTooSmallGoesToo) {
  CutMesh cut = square(4);
  cut.mesh.vertices.emplace_back(100, 100, 0); // used by nobody
  cut.vertex_faults.push_back({-1, -1});
  const VertexCorners corners(cut.mesh);
  TriangleRemoval removal(cut, corners);
  // Next to its corner vertex 0 stays one triangle, joined to the rest by a vertex at most.
  removal.take({1, 2, 3, 8, 9, 10, 11});
  const TriangleRemoval::Result result = removal.finish(2);
  EXPECT_EQ(result.crumbs, 1U);
  EXPECT_EQ(cut.mesh.triangles.size(), 24U);
  for (const Triangle& t : cut.mesh.triangles)
    for (const Index v : t)
      EXPECT_GT(cut.mesh.vertices[static_cast<std::size_t>(v)].norm(), 1.1);
  EXPECT_EQ(cut.mesh.vertices.size(), cut.vertex_faults.size());
  for (const Index v : result.touched)
    EXPECT_FALSE(trianglesAt(cut, v).empty());
}

TEST(TriangleRemoval, NeverTakesAll) {
  CutMesh cut = square(1);
  const VertexCorners corners(cut.mesh);
  TriangleRemoval removal(cut, corners);
  EXPECT_EQ(removal.take({0}), 1U);
  EXPECT_EQ(removal.take({1}), 0U);
  removal.finish(1);
  EXPECT_EQ(cut.mesh.triangles.size(), 1U);
  EXPECT_EQ(cut.mesh.vertices.size(), 3U);
}

} // namespace
} // namespace graben
