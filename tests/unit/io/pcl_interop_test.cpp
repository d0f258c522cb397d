// What graben writes, as PCL's own readers (those of pcl_viewer) see it.
#include "graben/io/mesh_writer.h"
#include "sample_mesh.h"
#include "support/temp_folder.h"

#include <gtest/gtest.h>
#include <pcl/PolygonMesh.h>
#include <pcl/io/vtk_lib_io.h>

namespace graben {
namespace {

class PclReads : public testing::TestWithParam<std::string> {};

TEST_P(PclReads, verticesAndTriangles) {
  const test::TempFolder folder;
  const std::string path = folder.path("m" + GetParam());
  TriangleMesh mesh = test::sampleMesh();
  for (Vector3& v : mesh.vertices)
    v -= Vector3(460288, 5933079, 1658);
  writeMesh(path, mesh);
  pcl::PolygonMesh read;
  ASSERT_GT(pcl::io::loadPolygonFile(path, read), 0);
  EXPECT_EQ(read.polygons.size(), 4U);
  EXPECT_EQ(read.cloud.width * read.cloud.height, 8U);
  float last[3];
  std::memcpy(last, &read.cloud.data[7 * read.cloud.point_step], sizeof(last));
  for (int k = 0; k < 3; ++k)
    EXPECT_NEAR(last[k], mesh.vertices[7][k], 1e-4);
}

INSTANTIATE_TEST_SUITE_P(MeshFormats, PclReads, testing::Values(".ply", ".vtk", ".obj", ".stl"),
                         [](const auto& test) { return test.param.substr(1); });

} // namespace
} // namespace graben
