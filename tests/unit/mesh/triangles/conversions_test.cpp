#include "graben/mesh/conversions.h"

#include "graben/core/errors.h"
#include "unit/mesh/meshes.h"

#include <pcl/conversions.h>
#include <pcl/point_types.h>

#include <gmock/gmock.h>

#include <cmath>
#include <cstring>
#include <limits>

namespace graben {
namespace {

using testing::ElementsAre;

TriangleMesh fullMesh() {
  TriangleMesh mesh = test::gridMesh(2, 0.5);
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    mesh.normals.emplace_back(0.0, 0.6, 0.8);
    mesh.piece.push_back(static_cast<Index>(v % 2));
    mesh.scalars["error"].push_back(static_cast<float>(v) / 7.0F);
    mesh.scalars["curvature"].push_back(std::numeric_limits<float>::quiet_NaN());
  }
  return mesh;
}

pcl::PolygonMesh polygonMesh(const TriangleMesh& mesh) {
  pcl::PolygonMesh out;
  toPolygonMesh(mesh, out);
  return out;
}

TEST(Conversions, RoundTripKeepsEveryArray) {
  const TriangleMesh mesh = fullMesh();
  const TriangleMesh back = fromPolygonMesh(polygonMesh(mesh));
  EXPECT_EQ(back.vertices, mesh.vertices); // multiples of 0.5 are exact in float32
  EXPECT_EQ(back.triangles, mesh.triangles);
  EXPECT_EQ(back.piece, mesh.piece);
  ASSERT_EQ(back.normals.size(), mesh.normals.size());
  EXPECT_LT((back.normals[3] - mesh.normals[3]).norm(), 1e-7);
  ASSERT_EQ(back.scalars.size(), 2U);
  EXPECT_EQ(back.scalars.at("error"), mesh.scalars.at("error"));
  EXPECT_TRUE(std::isnan(back.scalars.at("curvature")[4]));
}

TEST(Conversions, PclReadsTheCloud) {
  const pcl::PolygonMesh mesh = polygonMesh(fullMesh());
  pcl::PointCloud<pcl::PointNormal> cloud;
  pcl::fromPCLPointCloud2(mesh.cloud, cloud);
  ASSERT_EQ(cloud.size(), 9U);
  EXPECT_FLOAT_EQ(cloud[5].x, 1.0F);
  EXPECT_FLOAT_EQ(cloud[5].y, 0.5F);
  EXPECT_FLOAT_EQ(cloud[5].normal_z, 0.8F);
  EXPECT_EQ(mesh.polygons.size(), 8U);
}

TEST(Conversions, ReadsPaddedPclPointTypes) {
  pcl::PointCloud<pcl::PointNormal> cloud;
  for (int i = 0; i < 3; ++i) {
    pcl::PointNormal p;
    p.x = static_cast<float>(i);
    p.y = static_cast<float>(i * i);
    p.normal_x = 1.0F;
    cloud.push_back(p);
  }
  pcl::PolygonMesh mesh;
  pcl::toPCLPointCloud2(cloud, mesh.cloud);
  mesh.polygons.resize(1);
  mesh.polygons[0].vertices = {0, 1, 2};
  const TriangleMesh read = fromPolygonMesh(mesh);
  EXPECT_EQ(read.vertices[2], Vector3(2.0, 4.0, 0.0));
  EXPECT_EQ(read.normals[1], Vector3(1.0, 0.0, 0.0));
  EXPECT_THAT(read.triangles, ElementsAre(Triangle{0, 1, 2}));
}

TEST(Conversions, ReadsDoubleCoordinatesInFull) {
  pcl::PolygonMesh mesh;
  const std::array<double, 3> point{523456.789, 6541234.567, -2345.678};
  const std::array<const char*, 3> names{"x", "y", "z"};
  for (std::uint32_t i = 0; i < 3; ++i) {
    pcl::PCLPointField field;
    field.name = names[i];
    field.offset = 8 * i;
    field.datatype = pcl::PCLPointField::FLOAT64;
    field.count = 1;
    mesh.cloud.fields.push_back(field);
  }
  mesh.cloud.width = mesh.cloud.height = 1;
  mesh.cloud.point_step = mesh.cloud.row_step = 24;
  mesh.cloud.data.resize(24);
  std::memcpy(mesh.cloud.data.data(), point.data(), 24);
  EXPECT_EQ(fromPolygonMesh(mesh).vertices[0], Vector3(point[0], point[1], point[2]));
}

TEST(Conversions, SplitsPolygonsAndLeavesOutBadOnes) {
  pcl::PolygonMesh mesh = polygonMesh(test::gridMesh(2));
  mesh.polygons.assign(5, pcl::Vertices());
  mesh.polygons[0].vertices = {0, 1, 4, 3};
  mesh.polygons[1].vertices = {0, 1};
  mesh.polygons[2].vertices = {0, 1, 99};
  mesh.polygons[3].vertices = {0, 1, -1};
  mesh.polygons[4].vertices = {1, 8, 7};
  const float nan = std::numeric_limits<float>::quiet_NaN();
  std::memcpy(mesh.cloud.data.data() + std::size_t{2} * mesh.cloud.point_step, &nan, sizeof nan);
  const TriangleMesh read = fromPolygonMesh(mesh);
  EXPECT_EQ(read.vertices.size(), 8U); // vertex 2 is not finite
  EXPECT_THAT(read.triangles, ElementsAre(Triangle{0, 1, 3}, Triangle{0, 3, 2}, Triangle{1, 7, 6}));
  EXPECT_NO_THROW(validate(read, "test"));
}

TEST(Conversions, RejectsCloudsThatAreNotWhatTheySay) {
  EXPECT_THROW(fromPolygonMesh(pcl::PolygonMesh()), InvalidInputError);
  pcl::PolygonMesh short_data = polygonMesh(test::gridMesh(2));
  short_data.cloud.data.resize(20);
  EXPECT_THROW(fromPolygonMesh(short_data), InvalidInputError);
  pcl::PolygonMesh far_field = polygonMesh(test::gridMesh(2));
  far_field.cloud.fields[2].offset = 1000000;
  EXPECT_THROW(fromPolygonMesh(far_field), InvalidInputError);
  TriangleMesh clash = test::gridMesh(1);
  clash.scalars["x"].assign(4, 0.0F);
  EXPECT_THROW(polygonMesh(clash), InvalidInputError);
}

TEST(Conversions, AnEmptyMeshStaysEmpty) {
  const TriangleMesh back = fromPolygonMesh(polygonMesh(TriangleMesh()));
  EXPECT_TRUE(back.vertices.empty());
  EXPECT_TRUE(back.triangles.empty());
}

TEST(Conversions, ABlockOfAModelIsAClosedPolygonMesh) {
  SealedMesh model; // two tetrahedra on one face
  const Vector3 origin(461000.0, 5931000.0, -1700.0);
  for (const Vector3& p : {Vector3(0, 0, 0), Vector3(1, 0, 0), Vector3(0, 1, 0), Vector3(0, 0, 1), Vector3(0, 0, -1)})
    model.vertices.push_back(origin + p);
  model.triangles = {{0, 1, 2}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {1, 0, 4}, {2, 1, 4}, {0, 2, 4}};
  model.triangle_patch = {0, 1, 1, 1, 2, 2, 2};
  model.surfaces = {{"between", SealedSurfaceKind::Horizon}, {"around", SealedSurfaceKind::Wall}};
  model.patches = {{0, 1, 0}, {1, 0, -1}, {1, 1, -1}};
  model.blocks.resize(2);
  pcl::PolygonMesh block;
  toPolygonMesh(model, 1, origin, block);
  EXPECT_EQ(block.polygons.size(), 4U);
  const TriangleMesh back = fromPolygonMesh(block);
  EXPECT_NEAR(enclosedVolume(back.vertices, back.triangles), 1.0 / 6.0, 1e-7);
  EXPECT_EQ(back.piece.size(), 4U);
  EXPECT_THROW(toPolygonMesh(model, 2, origin, block), InvalidInputError);
}

} // namespace
} // namespace graben
