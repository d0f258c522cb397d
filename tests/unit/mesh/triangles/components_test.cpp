#include "graben/mesh/components.h"

#include "graben/core/errors.h"
#include "unit/mesh/meshes.h"

#include <gmock/gmock.h>

namespace graben {
namespace {

using testing::ElementsAre;

/// A lone triangle, a strip of two, another lone triangle and a vertex nobody uses.
TriangleMesh threeParts() {
  TriangleMesh mesh;
  for (int v = 0; v < 11; ++v)
    mesh.vertices.emplace_back(v, v % 3, 0.0);
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}, {5, 4, 6}, {8, 9, 10}};
  return mesh;
}

TEST(Components, AreNumberedByFallingSizeThenByFirstTriangle) {
  const Components c = connectedComponents(threeParts());
  EXPECT_THAT(c.of_triangle, ElementsAre(1, 0, 0, 2));
  EXPECT_THAT(c.of_vertex, ElementsAre(1, 1, 1, 0, 0, 0, 0, -1, 2, 2, 2));
  EXPECT_THAT(c.triangle_count, ElementsAre(2U, 1U, 1U));
}

TEST(Components, JoinOverASharedVertex) {
  TriangleMesh mesh = threeParts();
  mesh.triangles.push_back({2, 7, 10});
  EXPECT_THAT(connectedComponents(mesh).triangle_count, ElementsAre(3U, 2U));
}

TEST(Components, OfNothingAreNone) {
  const Components c = connectedComponents(TriangleMesh());
  EXPECT_TRUE(c.of_vertex.empty());
  EXPECT_TRUE(c.triangle_count.empty());
}

TEST(Components, ALongChainDoesNotTakeForever) {
  TriangleMesh mesh;
  constexpr Index n = 200000;
  for (Index v = 0; v < n; ++v)
    mesh.vertices.emplace_back(v, v % 2, 0.0);
  for (Index v = n - 3; v >= 0; --v)
    mesh.triangles.push_back({v, v + 1, v + 2});
  EXPECT_THAT(connectedComponents(mesh).triangle_count,
              ElementsAre(static_cast<std::size_t>(n - 2)));
}

TEST(Components, LabelPiecesNeedsAllVerticesUsed) {
  TriangleMesh mesh = threeParts();
  EXPECT_THROW(labelPieces(mesh), InvalidInputError);
  removeUnreferencedVertices(mesh);
  labelPieces(mesh);
  EXPECT_THAT(mesh.piece, ElementsAre(1, 1, 1, 0, 0, 0, 0, 2, 2, 2));
}

TEST(Components, SplitKeepsTrianglesVerticesAndArrays) {
  TriangleMesh mesh = threeParts();
  for (int v = 0; v < 11; ++v) {
    mesh.normals.emplace_back(0.0, 0.0, 1.0);
    mesh.piece.push_back(100 + v);
    mesh.scalars["error"].push_back(static_cast<float>(v) / 2.0F);
  }
  const auto parts = splitComponents(mesh, connectedComponents(mesh));
  ASSERT_EQ(parts.size(), 3U);
  EXPECT_THAT(parts[0].triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{2, 1, 3}));
  EXPECT_THAT(parts[0].piece, ElementsAre(103, 104, 105, 106));
  EXPECT_THAT(parts[2].scalars.at("error"), ElementsAre(4.0F, 4.5F, 5.0F));
  EXPECT_EQ(parts[1].vertices[2], mesh.vertices[2]);
  for (const TriangleMesh& part : parts)
    EXPECT_NO_THROW(validate(part, "test"));
}

} // namespace
} // namespace graben
