#include "two_levels.h"

#include "graben/features/fault_constrained_normal_estimation.h"
#include "graben/filters/fault_zone.h"
#include "graben/filters/wrong_side_filter.h"
#include "graben/mesh/conversions.h"
#include "graben/pipeline/faulted_horizon_reconstruction.h"
#include "graben/surface/fault_cutter.h"
#include "graben/surface/hoppe_marching_cubes.h"
#include "graben/surface/qem_fault_fitter.h"

#include <pcl/features/normal_3d_omp.h>
#include <pcl/search/kdtree.h>

#include <gmock/gmock.h>

namespace graben {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using Normals = FaultConstrainedNormalEstimation<pcl::PointXYZ, pcl::PointNormal>;

/// What is wrong but gives a result all the same: Complete, with a message.
class OddInput : public test::Contract {
protected:
  static pcl::PolygonMesh::Ptr flatMesh() {
    TriangleMesh mesh;
    constexpr Index kSide = 41;
    for (Index j = 0; j < kSide; ++j)
      for (Index i = 0; i < kSide; ++i)
        mesh.vertices.emplace_back(i - 20, j - 20, i <= 20 ? 2.0 : -2.0);
    for (Index j = 0; j + 1 < kSide; ++j)
      for (Index i = 0; i + 1 < kSide; ++i) {
        const Index v = j * kSide + i;
        mesh.triangles.push_back({v, v + 1, v + kSide + 1});
        mesh.triangles.push_back({v, v + kSide + 1, v + kSide});
      }
    auto polygons = pcl::make_shared<pcl::PolygonMesh>();
    toPolygonMesh(mesh, *polygons);
    return polygons;
  }

  /// The message of a fit that is Complete.
  static std::string fitted(QEMFaultFitter& fitter, const pcl::PolygonMesh::ConstPtr& mesh) {
    pcl::PolygonMesh out;
    fitter.setInputMesh(mesh);
    fitter.process(out);
    EXPECT_EQ(fitter.getStatus(), SurfaceStatus::Complete) << fitter.getStatusMessage();
    EXPECT_EQ(out.polygons.size(), mesh->polygons.size());
    return fitter.getStatusMessage();
  }

  static pcl::PolygonMesh::Ptr cut(const pcl::PolygonMesh::ConstPtr& mesh, std::shared_ptr<const FaultNetwork> faults) {
    FaultCutter cutter;
    cutter.setInputMesh(mesh);
    cutter.setFaults(std::move(faults));
    auto out = pcl::make_shared<pcl::PolygonMesh>();
    cutter.process(*out);
    return out;
  }
};

TEST_F(OddInput, FaultsOfAnotherFrameAreToldByTheNormals) {
  Normals normals;
  pcl::PointCloud<pcl::PointNormal> out;
  normals.setInputCloud(test::twoLevels<pcl::PointXYZ>());
  normals.setFaults(test::uprightFault());
  normals.compute(out);
  EXPECT_THAT(normals.getStatusMessage(), IsEmpty());
  normals.setFaults(test::faultOfAnotherFrame());
  normals.compute(out);
  EXPECT_EQ(normals.getStatus(), NormalEstimationStatus::Complete);
  EXPECT_THAT(normals.getStatusMessage(), HasSubstr("another frame"));
}

TEST_F(OddInput, FaultsOfAnotherFrameAreToldByTheFilters) {
  FaultZone<pcl::PointXYZ> zone;
  WrongSidePicks<pcl::PointXYZ> wrong;
  pcl::Indices kept;
  for (FaultFilter<pcl::PointXYZ>* filter : std::initializer_list<FaultFilter<pcl::PointXYZ>*>{&zone, &wrong}) {
    filter->setInputCloud(test::twoLevels<pcl::PointXYZ>());
    filter->setFaults(test::uprightFault());
    filter->filter(kept);
    EXPECT_THAT(filter->getStatusMessage(), IsEmpty());
    filter->setFaults(test::faultOfAnotherFrame());
    filter->filter(kept);
    EXPECT_EQ(filter->getStatus(), FilterStatus::Complete);
    EXPECT_THAT(filter->getStatusMessage(), HasSubstr("another frame"));
  }
  zone.setFaults(nullptr);
  zone.filter(kept);
  EXPECT_THAT(zone.getStatusMessage(), HasSubstr("no faults"));
}

TEST_F(OddInput, FaultsOfAnotherFrameAreToldByTheSurface) {
  HoppeMarchingCubes<pcl::PointNormal> cubes;
  pcl::PolygonMesh out;
  cubes.setInputCloud(test::twoLevels<pcl::PointNormal>());
  cubes.setFaults(test::uprightFault());
  cubes.reconstruct(out);
  EXPECT_THAT(cubes.getStatusMessage(), IsEmpty());
  cubes.setFaults(test::faultOfAnotherFrame());
  cubes.reconstruct(out);
  EXPECT_EQ(cubes.getStatus(), SurfaceStatus::Complete);
  EXPECT_FALSE(out.polygons.empty());
  EXPECT_THAT(cubes.getStatusMessage(), HasSubstr("another frame"));
}

TEST_F(OddInput, FaultsOfAnotherFrameAreToldByTheCutter) {
  FaultCutter cutter;
  pcl::PolygonMesh out;
  cutter.setInputMesh(flatMesh());
  cutter.setFaults(test::uprightFault());
  cutter.process(out);
  EXPECT_THAT(cutter.getStatusMessage(), IsEmpty());
  cutter.setFaults(test::faultOfAnotherFrame());
  cutter.process(out);
  EXPECT_EQ(cutter.getStatus(), SurfaceStatus::Complete);
  EXPECT_THAT(cutter.getStatusMessage(), HasSubstr("another frame"));
  cutter.setFaults(nullptr);
  cutter.process(out);
  EXPECT_THAT(cutter.getStatusMessage(), HasSubstr("no faults"));
}

TEST_F(OddInput, FaultsOfAnotherFrameAreToldByTheWholeJob) {
  FaultedHorizonReconstruction<pcl::PointXYZ> job;
  pcl::PolygonMesh out;
  job.setInputCloud(test::twoLevels<pcl::PointXYZ>());
  job.setFaults(test::faultOfAnotherFrame());
  job.reconstruct(out);
  EXPECT_EQ(job.getStatus(), SurfaceStatus::Complete);
  EXPECT_THAT(job.getStatusMessage(), HasSubstr("does not touch"));
}

/// On a horizon that runs through the viewpoint's height, half of the normals point down.
TEST_F(OddInput, NormalsTurnedTowardsAViewpointAreTold) {
  const auto cloud = test::twoLevels<pcl::PointNormal>();
  for (pcl::PointNormal& p : *cloud)
    p.z = 0.05F * p.x;
  pcl::NormalEstimationOMP<pcl::PointNormal, pcl::PointNormal> plain;
  plain.setInputCloud(cloud);
  plain.setKSearch(15);
  plain.setViewPoint(0.0F, 0.0F, 100.0F);
  plain.compute(*cloud);
  HoppeMarchingCubes<pcl::PointNormal> cubes;
  pcl::PolygonMesh out;
  cubes.setInputCloud(cloud);
  cubes.reconstruct(out);
  EXPECT_THAT(cubes.getStatusMessage(), IsEmpty()) << "a viewpoint above all points does no harm";
  plain.setViewPoint(2.0F, 1.0F, 0.1F);
  plain.compute(*cloud);
  cubes.reconstruct(out);
  EXPECT_EQ(cubes.getStatus(), SurfaceStatus::Complete) << cubes.getStatusMessage();
  EXPECT_THAT(cubes.getStatusMessage(), HasSubstr("viewpoint"));
}

TEST_F(OddInput, ASearchMethodIsRefused) {
  Normals normals;
  pcl::PointCloud<pcl::PointNormal> estimated;
  normals.setInputCloud(test::twoLevels<pcl::PointXYZ>());
  normals.setSearchMethod(pcl::make_shared<pcl::search::KdTree<pcl::PointXYZ>>());
  normals.compute(estimated);
  EXPECT_EQ(normals.getStatus(), NormalEstimationStatus::Complete);
  EXPECT_THAT(normals.getStatusMessage(), HasSubstr("search method"));
  HoppeMarchingCubes<pcl::PointNormal> cubes;
  FaultedHorizonReconstruction<pcl::PointNormal> job;
  pcl::PolygonMesh out;
  const auto refuses = [&](auto& surface) {
    surface.setInputCloud(test::twoLevels<pcl::PointNormal>());
    surface.setSearchMethod(pcl::make_shared<pcl::search::KdTree<pcl::PointNormal>>());
    surface.reconstruct(out);
    EXPECT_EQ(surface.getStatus(), SurfaceStatus::Complete);
    EXPECT_THAT(surface.getStatusMessage(), HasSubstr("search method"));
  };
  refuses(cubes);
  refuses(job);
}

TEST_F(OddInput, AFitWithoutFaultsOrCutOrCloudNearbyIsTold) {
  const auto mesh = flatMesh();
  const auto faults = test::uprightFault();
  const auto sealed = cut(mesh, faults);
  QEMFaultFitter fitter;
  fitter.setInputCloud(test::twoLevels<pcl::PointNormal>());
  EXPECT_THAT(fitted(fitter, sealed), HasSubstr("no faults"));
  fitter.setZoneWidth(std::numeric_limits<double>::infinity());
  EXPECT_THAT(fitted(fitter, sealed), IsEmpty()) << "the whole mesh, which needs no faults";
  fitter.setZoneWidth(0.0);
  fitter.setFaults(faults);
  EXPECT_THAT(fitted(fitter, sealed), IsEmpty());
  EXPECT_GT(fitter.getResult().fitted, 0U);
  EXPECT_THAT(fitted(fitter, mesh), HasSubstr("not cut"));
  fitter.setFaults(test::faultOfAnotherFrame());
  EXPECT_THAT(fitted(fitter, sealed), HasSubstr("another frame"));
  fitter.setFaults(faults);
  auto far = test::twoLevels<pcl::PointNormal>();
  for (pcl::PointNormal& p : *far)
    p.x += 1e5F;
  fitter.setInputCloud(far);
  EXPECT_THAT(fitted(fitter, sealed), HasSubstr("within reach"));
  EXPECT_EQ(fitter.getResult().fitted, 0U);
}

TEST_F(OddInput, AFilterWithoutACloudFails) {
  FaultZone<pcl::PointXYZ> zone;
  pcl::Indices kept{1, 2};
  zone.filter(kept);
  EXPECT_EQ(zone.getStatus(), FilterStatus::Failed);
  EXPECT_THAT(zone.getStatusMessage(), HasSubstr("missing"));
  EXPECT_TRUE(kept.empty());
}

TEST_F(OddInput, NoPlanesToAverageOverAreRefused) {
  HoppeMarchingCubes<pcl::PointNormal> cubes;
  pcl::PolygonMesh out;
  cubes.setInputCloud(test::twoLevels<pcl::PointNormal>());
  cubes.setBlend(0);
  cubes.reconstruct(out);
  EXPECT_EQ(cubes.getStatus(), SurfaceStatus::Failed);
  EXPECT_THAT(cubes.getStatusMessage(), HasSubstr("1 plane or more"));
  EXPECT_TRUE(out.polygons.empty());
}

} // namespace
} // namespace graben
