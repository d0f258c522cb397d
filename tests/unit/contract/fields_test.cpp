#include "two_levels.h"

#include "graben/pipeline/faulted_horizon_reconstruction.h"
#include "graben/surface/hoppe_marching_cubes.h"

#include <pcl/common/io.h>
#include <pcl/conversions.h>

#include <set>

namespace graben {
namespace {

/// Red west of the fault, blue east of it; intensity is x.
template <typename PointT>
typename pcl::PointCloud<PointT>::Ptr colored() {
  auto cloud = test::twoLevels<PointT>();
  for (PointT& p : *cloud) {
    p.r = p.x < 0.25F ? 200 : 10;
    p.b = p.x < 0.25F ? 10 : 200;
    p.g = 50;
  }
  return cloud;
}

/// Colours of the pieces' vertices that are not those of their own side; all where there are none.
template <typename PointT>
std::size_t wronglyColored(const pcl::PointCloud<PointT>& vertices) {
  std::size_t wrong = 0;
  for (const PointT& v : vertices)
    wrong += v.g != 50 || (v.z > 0.0F) != (v.r == 200) || (v.z < 0.0F) != (v.b == 200) ? 1U : 0U;
  return wrong;
}

class CarriedFields : public test::Contract {};

TEST_F(CarriedFields, VerticesOfMarchingCubesTakeThoseOfTheirSide) {
  HoppeMarchingCubes<pcl::PointXYZRGBNormal> cubes;
  cubes.setInputCloud(colored<pcl::PointXYZRGBNormal>());
  cubes.setFaults(test::uprightFault());
  pcl::PointCloud<pcl::PointXYZRGBNormal> vertices;
  std::vector<pcl::Vertices> polygons;
  cubes.reconstruct(vertices, polygons);
  ASSERT_GT(vertices.size(), 5000U);
  EXPECT_EQ(wronglyColored(vertices), 0U);
  for (const auto& v : vertices)
    EXPECT_GT(v.normal_z, 0.9F) << "normals stay the surface's own";
  cubes.setTransferFields(false);
  cubes.reconstruct(vertices, polygons);
  EXPECT_EQ(wronglyColored(vertices), vertices.size());
}

TEST_F(CarriedFields, VerticesOfTheWholeJobTakeThoseOfTheirSide) {
  FaultedHorizonReconstruction<pcl::PointXYZRGB> job;
  job.setInputCloud(colored<pcl::PointXYZRGB>());
  job.setFaults(test::uprightFault());
  pcl::PolygonMesh mesh;
  job.reconstruct(mesh);
  ASSERT_EQ(job.getStatus(), SurfaceStatus::Complete) << job.getStatusMessage();
  pcl::PointCloud<pcl::PointXYZRGB> vertices;
  pcl::fromPCLPointCloud2(mesh.cloud, vertices);
  ASSERT_GT(vertices.size(), 5000U);
  EXPECT_EQ(wronglyColored(vertices), 0U);
  const std::vector<pcl::PolygonMesh> pieces = job.getPieces();
  ASSERT_EQ(pieces.size(), 2U);
  std::size_t triangles = 0;
  for (const pcl::PolygonMesh& piece : pieces) {
    pcl::fromPCLPointCloud2(piece.cloud, vertices);
    EXPECT_EQ(wronglyColored(vertices), 0U);
    for (const auto& v : vertices)
      EXPECT_EQ(v.z > 0.0F, vertices[0].z > 0.0F) << "a piece lies on one side";
    triangles += piece.polygons.size();
    EXPECT_EQ(piece.header.frame_id, "survey");
  }
  EXPECT_EQ(triangles, mesh.polygons.size());
  job.setTransferFields(false);
  job.reconstruct(mesh);
  EXPECT_EQ(pcl::getFieldIndex(mesh.cloud, "rgb"), -1);
  std::vector<pcl::Vertices> polygons;
  job.setTransferFields(true);
  job.reconstruct(vertices, polygons);
  EXPECT_EQ(wronglyColored(vertices), 0U);
}

TEST_F(CarriedFields, TheLabelIsThePieceUnlessPointsHaveTheirOwn) {
  const auto labels = [](auto& job) {
    pcl::PolygonMesh mesh;
    job.setFaults(test::uprightFault());
    job.reconstruct(mesh);
    pcl::PointCloud<pcl::PointXYZL> vertices;
    pcl::fromPCLPointCloud2(mesh.cloud, vertices);
    std::set<std::uint32_t> found;
    for (const pcl::PointXYZL& v : vertices)
      found.insert(v.label);
    return found;
  };
  FaultedHorizonReconstruction<pcl::PointXYZ> plain;
  plain.setInputCloud(test::twoLevels<pcl::PointXYZ>());
  EXPECT_EQ(labels(plain), (std::set<std::uint32_t>{0, 1}));
  FaultedHorizonReconstruction<pcl::PointXYZL> labelled;
  auto cloud = test::twoLevels<pcl::PointXYZL>();
  for (pcl::PointXYZL& p : *cloud)
    p.label = p.x < 0.25F ? 17 : 18;
  labelled.setInputCloud(cloud);
  EXPECT_EQ(labels(labelled), (std::set<std::uint32_t>{17, 18}));
}

/// A pick on the wrong side gives nobody its colour.
TEST_F(CarriedFields, PicksSetAsideGiveNothing) {
  auto cloud = colored<pcl::PointXYZRGB>();
  pcl::PointXYZRGB stray = (*cloud)[0];
  stray.x = 0.6F;
  stray.y = 0.3F;
  stray.z = 2.0F;
  stray.r = stray.g = stray.b = 77;
  cloud->push_back(stray);
  FaultedHorizonReconstruction<pcl::PointXYZRGB> job;
  job.setInputCloud(cloud);
  job.setFaults(test::uprightFault());
  pcl::PolygonMesh mesh;
  job.reconstruct(mesh);
  ASSERT_NE(job.getResult().pick_reason.back(), PickReason::Good);
  pcl::PointCloud<pcl::PointXYZRGB> vertices;
  pcl::fromPCLPointCloud2(mesh.cloud, vertices);
  EXPECT_EQ(wronglyColored(vertices), 0U);
}

} // namespace
} // namespace graben
