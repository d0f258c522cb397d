#include "graben/mesh/triangle_mesh.h"

#include "graben/core/errors.h"
#include "graben/mesh/bounds.h"
#include "unit/mesh/meshes.h"

#include <gmock/gmock.h>

#include <limits>

namespace graben {
namespace {

using testing::ElementsAre;

TriangleMesh withArrays(TriangleMesh mesh) {
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    mesh.normals.push_back(Vector3::UnitX() * static_cast<double>(v));
    mesh.piece.push_back(static_cast<Index>(v));
    mesh.scalars["s"].push_back(static_cast<float>(v));
  }
  return mesh;
}

TEST(TriangleMesh, RemoveUnreferencedVerticesKeepsOrderAndArrays) {
  TriangleMesh mesh;
  for (int v = 0; v < 6; ++v)
    mesh.vertices.emplace_back(v, 0, 0);
  mesh.triangles = {{5, 1, 3}};
  mesh = withArrays(mesh);
  removeUnreferencedVertices(mesh);
  EXPECT_THAT(mesh.triangles, ElementsAre(Triangle{2, 0, 1}));
  EXPECT_THAT(mesh.piece, ElementsAre(1, 3, 5));
  EXPECT_THAT(mesh.scalars.at("s"), ElementsAre(1.0F, 3.0F, 5.0F));
  EXPECT_EQ(mesh.vertices[1], Vector3(3, 0, 0));
  EXPECT_EQ(mesh.normals[2], Vector3(5, 0, 0));
  mesh.triangles.clear();
  removeUnreferencedVertices(mesh);
  EXPECT_TRUE(mesh.vertices.empty());
  EXPECT_NO_THROW(validate(mesh, "test"));
}

TEST(TriangleMesh, AppendKeepsArraysBothHave) {
  TriangleMesh mesh = withArrays(test::gridMesh(1));
  TriangleMesh other = withArrays(test::gridMesh(1));
  other.normals.clear();
  other.scalars["t"].assign(4, 0.0F);
  append(mesh, other);
  EXPECT_EQ(mesh.vertices.size(), 8U);
  EXPECT_EQ(mesh.triangles[2], (Triangle{4, 5, 7}));
  EXPECT_TRUE(mesh.normals.empty());
  EXPECT_THAT(mesh.piece, ElementsAre(0, 1, 2, 3, 0, 1, 2, 3));
  EXPECT_EQ(mesh.scalars.size(), 1U);
  EXPECT_NO_THROW(validate(mesh, "test"));
}

TEST(TriangleMesh, AppendToOrOfNothingKeepsAll) {
  TriangleMesh mesh;
  append(mesh, withArrays(test::gridMesh(1)));
  append(mesh, TriangleMesh());
  EXPECT_EQ(mesh.normals.size(), 4U);
  EXPECT_EQ(mesh.scalars.at("s").size(), 4U);
  append(mesh, mesh);
  EXPECT_EQ(mesh.vertices.size(), 8U);
  EXPECT_EQ(mesh.piece.size(), 8U);
  EXPECT_NO_THROW(validate(mesh, "test"));
}

TEST(TriangleMesh, FlipTurnsTrianglesAndNormals) {
  TriangleMesh mesh = test::gridMesh(1);
  mesh.normals.assign(4, Vector3::UnitZ());
  flipOrientation(mesh);
  EXPECT_EQ(mesh.triangles[0], (Triangle{0, 3, 1}));
  EXPECT_EQ(mesh.normals[0], Vector3(0, 0, -1));
}

TEST(TriangleMesh, ValidateSaysWhatIsWrong) {
  const auto message = [](const TriangleMesh& mesh) -> std::string {
    try {
      validate(mesh, "cutting");
    } catch (const InvalidInputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(message(test::gridMesh(2)), "");
  TriangleMesh high = test::gridMesh(1);
  high.triangles[1][2] = 4;
  EXPECT_THAT(message(high), testing::HasSubstr("cutting: triangle 1 names vertex 4"));
  TriangleMesh negative = test::gridMesh(1);
  negative.triangles[0][0] = -1;
  EXPECT_THAT(message(negative), testing::HasSubstr("vertex -1"));
  TriangleMesh nan = test::gridMesh(1);
  nan.vertices[2].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(message(nan), testing::HasSubstr("vertex 2"));
  TriangleMesh normals = test::gridMesh(1);
  normals.normals.resize(3);
  EXPECT_THAT(message(normals), testing::HasSubstr("normals"));
  TriangleMesh scalar = test::gridMesh(1);
  scalar.scalars["throw"].resize(5);
  EXPECT_THAT(message(scalar), testing::HasSubstr("throw"));
}

TEST(Bounds, OfPointsPassesOverWhatIsNotFinite) {
  const double inf = std::numeric_limits<double>::infinity();
  const Bounds bounds = boundsOf({{1, 2, 3}, {inf, 0, 0}, {-1, 5, 0}});
  EXPECT_EQ(bounds.low, Vector3(-1, 2, 0));
  EXPECT_EQ(bounds.high, Vector3(1, 5, 3));
  EXPECT_TRUE(boundsOf({}).empty());
  EXPECT_EQ(boundsOf({}).diagonal(), 0.0);
}

} // namespace
} // namespace graben
