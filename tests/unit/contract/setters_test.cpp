#include "two_levels.h"

#include "graben/features/fault_constrained_normal_estimation.h"
#include "graben/filters/fault_zone.h"
#include "graben/filters/wrong_side_filter.h"
#include "graben/pipeline/faulted_horizon_reconstruction.h"
#include "graben/surface/hoppe_marching_cubes.h"
#include "graben/surface/qem_fault_fitter.h"

namespace graben {
namespace {

/// Getters give back what was set, before and after a run; what a run used has getters of its own.
class Setters : public test::Contract {};

TEST_F(Setters, OfTheNormals) {
  FaultConstrainedNormalEstimation<pcl::PointXYZ, pcl::PointNormal> normals;
  const auto faults = test::uprightFault();
  normals.setInputCloud(test::twoLevels<pcl::PointXYZ>());
  normals.setFaults(faults);
  normals.setNeighbors(12);
  normals.setRho(0.0);
  normals.setDelta(0.25);
  normals.setNumberOfThreads(2);
  normals.setOrientation(NormalOrientation::UpAxis);
  normals.setUpAxis({0.0F, 0.0F, 2.0F});
  pcl::PointCloud<pcl::PointNormal> out;
  normals.compute(out);
  ASSERT_EQ(normals.getStatus(), NormalEstimationStatus::Complete);
  EXPECT_EQ(normals.getFaults(), faults);
  EXPECT_EQ(normals.getNeighbors(), 12);
  EXPECT_EQ(normals.getKSearch(), 12);
  EXPECT_EQ(normals.getRho(), 0.0);
  EXPECT_GT(normals.getUsedRho(), 0.1);
  EXPECT_EQ(normals.getDelta(), 0.25);
  EXPECT_EQ(normals.getUsedDelta(), 0.25);
  EXPECT_EQ(normals.getNumberOfThreads(), 2U);
  EXPECT_EQ(normals.getOrientation(), NormalOrientation::UpAxis);
  EXPECT_EQ(normals.getUpAxis().z(), 2.0F);
}

TEST_F(Setters, OfTheFilters) {
  FaultZone<pcl::PointXYZ> zone;
  WrongSidePicks<pcl::PointXYZ> wrong;
  pcl::Indices kept;
  wrong.setBand(3.0);
  wrong.setSigma(0.1);
  wrong.setTolerance(0.2);
  for (FaultFilter<pcl::PointXYZ>* filter : std::initializer_list<FaultFilter<pcl::PointXYZ>*>{&zone, &wrong}) {
    filter->setInputCloud(test::twoLevels<pcl::PointXYZ>());
    filter->setFaults(test::uprightFault());
    filter->setNumberOfThreads(1);
    filter->filter(kept);
    ASSERT_EQ(filter->getStatus(), FilterStatus::Complete);
    EXPECT_EQ(filter->getNumberOfThreads(), 1U);
  }
  EXPECT_EQ(zone.getWidth(), 0.0);
  EXPECT_NEAR(zone.getUsedWidth(), 2.5, 0.5);
  EXPECT_EQ(wrong.getBand(), 3.0);
  EXPECT_EQ(wrong.getSigma(), 0.1);
  EXPECT_EQ(wrong.getTolerance(), 0.2);
  EXPECT_EQ(wrong.getMeanDistance(), 0.0);
  EXPECT_EQ(wrong.getUsedOptions().band, 3.0);
  EXPECT_NEAR(wrong.getUsedOptions().mean_distance, 0.5, 0.1);
}

TEST_F(Setters, OfTheSurface) {
  HoppeMarchingCubes<pcl::PointNormal> cubes;
  pcl::PolygonMesh out;
  cubes.setInputCloud(test::twoLevels<pcl::PointNormal>());
  cubes.setFaultReach(4.0);
  cubes.setBlend(2);
  cubes.setSnap(0.2);
  cubes.setSmallestPiece(5);
  cubes.setFlipAngle(70.0);
  cubes.setMemoryLimit(std::size_t{1} << 33);
  cubes.setTransferFields(false);
  cubes.setNumberOfThreads(2);
  cubes.reconstruct(out);
  ASSERT_EQ(cubes.getStatus(), SurfaceStatus::Complete) << cubes.getStatusMessage();
  EXPECT_EQ(cubes.getVoxelSize(), 0.0);
  EXPECT_NEAR(cubes.getUsedVoxelSize(), 0.5, 0.1);
  EXPECT_EQ(cubes.getRho(), 0.0);
  EXPECT_GT(cubes.getUsedRho(), 0.1);
  EXPECT_EQ(cubes.getDelta(), 0.0);
  EXPECT_GE(cubes.getUsedDelta(), 0.0);
  EXPECT_EQ(cubes.getFaultReach(), 4.0);
  EXPECT_EQ(cubes.getBlend(), 2U);
  EXPECT_EQ(cubes.getSnap(), 0.2);
  EXPECT_EQ(cubes.getSmallestPiece(), 5U);
  EXPECT_EQ(cubes.getFlipAngle(), 70.0);
  EXPECT_EQ(cubes.getMemoryLimit(), std::size_t{1} << 33);
  EXPECT_FALSE(cubes.getTransferFields());
  EXPECT_EQ(cubes.getNumberOfThreads(), 2U);
  cubes.setVoxelSize(0.75);
  EXPECT_EQ(cubes.getVoxelSize(), 0.75) << "before a run";
}

TEST_F(Setters, OfTheFit) {
  HoppeMarchingCubes<pcl::PointNormal> cubes;
  const auto cloud = test::twoLevels<pcl::PointNormal>();
  const auto mesh = pcl::make_shared<pcl::PolygonMesh>();
  const auto faults = test::uprightFault();
  cubes.setInputCloud(cloud);
  cubes.setFaults(faults);
  cubes.reconstruct(*mesh);
  QEMFaultFitter fitter;
  fitter.setInputCloud(cloud);
  fitter.setInputMesh(mesh);
  fitter.setFaults(faults);
  fitter.setNeighbors(10);
  fitter.setPasses(3);
  fitter.setRelativeCutoff(0.1);
  fitter.setNumberOfThreads(2);
  pcl::PolygonMesh out;
  fitter.process(out);
  ASSERT_EQ(fitter.getStatus(), SurfaceStatus::Complete) << fitter.getStatusMessage();
  EXPECT_EQ(fitter.getInputCloud(), cloud);
  EXPECT_EQ(fitter.getInputCloud<pcl::PointXYZ>(), nullptr) << "of another type";
  EXPECT_EQ(fitter.getNeighbors(), 10);
  EXPECT_EQ(fitter.getPasses(), 3U);
  EXPECT_EQ(fitter.getRelativeCutoff(), 0.1);
  EXPECT_EQ(fitter.getNumberOfThreads(), 2U);
  for (const double set : {fitter.getZoneWidth(), fitter.getSearchRadius(), fitter.getMaxStep(), fitter.getTolerance()})
    EXPECT_EQ(set, 0.0);
  for (const double used : {fitter.getUsedZoneWidth(), fitter.getUsedSearchRadius(), fitter.getUsedMaxStep(), fitter.getUsedTolerance()})
    EXPECT_GT(used, 0.0);
}

TEST_F(Setters, OfTheWholeJob) {
  FaultedHorizonReconstruction<pcl::PointXYZ> job;
  ReconstructionOptions options;
  options.flip_angle = 75.0;
  job.setOptions(options);
  job.setZScale(2.0);
  job.setNumberOfThreads(2);
  job.setTransferFields(false);
  job.setInputCloud(test::twoLevels<pcl::PointXYZ>());
  pcl::PolygonMesh out;
  job.reconstruct(out);
  ASSERT_EQ(job.getStatus(), SurfaceStatus::Complete) << job.getStatusMessage();
  EXPECT_EQ(job.getOptions().flip_angle, 75.0);
  EXPECT_EQ(job.getReport().used.flip_angle, 75.0);
  EXPECT_EQ(job.getZScale(), 2.0);
  EXPECT_EQ(job.getVoxelSize(), 0.0);
  EXPECT_GT(job.getUsedVoxelSize(), 0.3);
  EXPECT_EQ(job.getNumberOfThreads(), 2U);
  EXPECT_FALSE(job.getTransferFields());
  EXPECT_TRUE(job.getFaultInputs().empty());
  EXPECT_TRUE(job.getDips().empty());
}

} // namespace
} // namespace graben
