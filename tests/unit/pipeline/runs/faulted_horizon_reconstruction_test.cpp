#include "graben/pipeline/faulted_horizon_reconstruction.h"
#include "small_model.h"

#include <pcl/console/print.h>

#include <gmock/gmock.h>

namespace graben {
namespace {

pcl::PointCloud<pcl::PointXYZ>::Ptr cloudOf(const Points& points) {
  auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  for (const Vector3& p : points)
    cloud->emplace_back(static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z()));
  cloud->header.frame_id = "survey";
  cloud->header.stamp = 7;
  return cloud;
}

Points exactly(const pcl::PointCloud<pcl::PointXYZ>& cloud) {
  Points points;
  for (const pcl::PointXYZ& p : cloud)
    points.emplace_back(p.x, p.y, p.z);
  return points;
}

class FaultedHorizonReconstructionTest : public testing::Test {
protected:
  FaultedHorizonReconstructionTest() : level_(pcl::console::getVerbosityLevel()) {
    pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
    job_.setInputCloud(cloud_);
    job_.setFaultInputs(test::faultsOf(model_));
  }
  ~FaultedHorizonReconstructionTest() override { pcl::console::setVerbosityLevel(level_); }

  pcl::console::VERBOSITY_LEVEL level_;
  SyntheticModel model_ = test::smallModel(SyntheticKind::Conjugate);
  pcl::PointCloud<pcl::PointXYZ>::Ptr cloud_ = cloudOf(model_.picks().points);
  FaultedHorizonReconstruction<pcl::PointXYZ> job_;
  pcl::PolygonMesh mesh_;
};

/// Bit for bit what the pipeline makes.
TEST_F(FaultedHorizonReconstructionTest, GivesWhatThePipelineGives) {
  const ReconstructionResult expected = HorizonReconstruction().reconstruct(exactly(*cloud_), test::faultsOf(model_));
  job_.reconstruct(mesh_);
  ASSERT_EQ(job_.getStatus(), SurfaceStatus::Complete) << job_.getStatusMessage();
  EXPECT_EQ(mesh_.header.frame_id, "survey");
  EXPECT_EQ(mesh_.cloud.header.stamp, 7U);
  ASSERT_EQ(mesh_.polygons.size(), expected.mesh.triangles.size());
  EXPECT_EQ(job_.getResult().mesh.vertices, expected.mesh.vertices);
  pcl::PointCloud<pcl::PointNormal> vertices;
  pcl::fromPCLPointCloud2(mesh_.cloud, vertices);
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    EXPECT_EQ(vertices[v].getVector3fMap(), expected.mesh.vertices[v].cast<float>());
    EXPECT_EQ(vertices[v].getNormalVector3fMap(), expected.mesh.normals[v].cast<float>());
  }
  EXPECT_EQ(toJson(job_.getReport(), false), toJson(expected.report, false));
  EXPECT_EQ(job_.getPieces().size(), 3U);
}

TEST_F(FaultedHorizonReconstructionTest, TakesANetworkOfFaultsToo) {
  std::vector<FaultSurface> surfaces;
  for (const FaultInput& fault : test::faultsOf(model_))
    for (FaultSurface& surface : faultSurfaces(fault).faults)
      surfaces.push_back(std::move(surface));
  job_.setFaultInputs({});
  job_.setFaults(std::make_shared<const FaultNetwork>(std::move(surfaces)));
  pcl::PointCloud<pcl::PointXYZ> points;
  std::vector<pcl::Vertices> polygons;
  job_.reconstruct(points, polygons);
  EXPECT_EQ(job_.getPieces().size(), 3U);
  EXPECT_EQ(points.size(), job_.getResult().mesh.vertices.size());
  EXPECT_EQ(polygons.size(), job_.getResult().mesh.triangles.size());
  EXPECT_EQ(points.header.frame_id, "survey");
}

TEST_F(FaultedHorizonReconstructionTest, UsesTheIndicesAlone) {
  auto west = pcl::make_shared<pcl::Indices>();
  for (std::size_t i = 0; i < cloud_->size(); ++i)
    if ((*cloud_)[i].x < -200.0F)
      west->push_back(static_cast<pcl::index_t>(i));
  job_.setIndices(west);
  job_.setFaultInputs({}); // to which the surface would be carried on
  job_.reconstruct(mesh_);
  EXPECT_EQ(job_.getReport().picks, west->size());
  for (const Vector3& v : job_.getResult().mesh.vertices)
    EXPECT_LT(v.x(), -100.0);
  west->push_back(static_cast<pcl::index_t>(cloud_->size()));
  job_.setIndices(west);
  job_.reconstruct(mesh_);
  EXPECT_EQ(job_.getStatus(), SurfaceStatus::Failed);
  EXPECT_THAT(job_.getStatusMessage(), testing::HasSubstr("index"));
}

TEST_F(FaultedHorizonReconstructionTest, WhatCannotBeUsedGivesAnEmptyMeshAndSaysWhy) {
  const auto expectFailure = [&](const char* what) {
    mesh_.polygons.resize(2);
    job_.reconstruct(mesh_);
    EXPECT_EQ(job_.getStatus(), SurfaceStatus::Failed) << what;
    EXPECT_FALSE(job_.getStatusMessage().empty()) << what;
    EXPECT_TRUE(mesh_.polygons.empty() && mesh_.cloud.data.empty()) << what;
    EXPECT_TRUE(job_.getPieces().empty()) << what;
  };
  job_.setInputCloud(nullptr);
  expectFailure("no cloud");
  job_.setInputCloud(cloudOf({{0, 0, 0}, {1, 1, 1}}));
  expectFailure("two points");
  job_.setInputCloud(cloud_);
  job_.setVoxelSize(-1.0);
  expectFailure("a negative voxel size");
}

TEST_F(FaultedHorizonReconstructionTest, ThreadsMakeNoDifference) {
  job_.setNumberOfThreads(1);
  job_.reconstruct(mesh_);
  const auto one = mesh_.cloud.data;
  job_.setNumberOfThreads(3);
  pcl::SurfaceReconstruction<pcl::PointXYZ>& base = job_;
  base.reconstruct(mesh_);
  EXPECT_EQ(mesh_.cloud.data, one);
}

} // namespace
} // namespace graben
