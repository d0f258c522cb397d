#include "two_levels.h"

#include "graben/features/fault_constrained_normal_estimation.h"
#include "graben/filters/fault_zone.h"
#include "graben/filters/wrong_side_filter.h"
#include "graben/pipeline/faulted_horizon_reconstruction.h"
#include "graben/surface/hoppe_marching_cubes.h"
#include "graben/surface/qem_fault_fitter.h"

namespace graben {
namespace {

/// Every class is compiled for the point types that PCL programs use.
template <typename PointT>
class PointTypes : public test::Contract {};

struct NameOf {
  template <typename PointT>
  static std::string GetName(int) {
    const std::string fields = pcl::getFieldsList(pcl::PointCloud<PointT>());
    std::string name;
    for (const char c : fields)
      name += c == ' ' ? '_' : c;
    return name + (std::is_same_v<PointT, pcl::PointXYZRGBA> ? "a" : "");
  }
};
using AllTypes = testing::Types<pcl::PointXYZ, pcl::PointXYZI, pcl::PointXYZL, pcl::PointXYZRGB, pcl::PointXYZRGBA, pcl::PointNormal, pcl::PointXYZINormal,
                                pcl::PointXYZRGBNormal>;
TYPED_TEST_SUITE(PointTypes, AllTypes, NameOf);

TYPED_TEST(PointTypes, AreTakenByEveryClass) {
  const auto cloud = test::twoLevels<TypeParam>(10.0);
  const auto faults = test::uprightFault();

  FaultConstrainedNormalEstimation<TypeParam, pcl::Normal> normals;
  FaultConstrainedNormalEstimation<TypeParam, pcl::PointXYZRGBNormal> colored;
  pcl::PointCloud<pcl::Normal> plain;
  pcl::PointCloud<pcl::PointXYZRGBNormal> with_color;
  normals.setInputCloud(cloud);
  normals.setFaults(faults);
  normals.compute(plain);
  EXPECT_EQ(normals.getStatus(), NormalEstimationStatus::Complete);
  colored.setInputCloud(cloud);
  colored.compute(with_color);
  EXPECT_EQ(with_color.size(), cloud->size());

  FaultZone<TypeParam> zone;
  WrongSidePicks<TypeParam> wrong;
  pcl::Indices near, good;
  zone.setInputCloud(cloud);
  zone.setFaults(faults);
  zone.filter(near);
  EXPECT_GT(near.size(), 0U);
  EXPECT_LT(near.size(), cloud->size());
  wrong.setInputCloud(cloud);
  wrong.setFaults(faults);
  wrong.filter(good);
  EXPECT_EQ(good.size(), cloud->size());

  FaultedHorizonReconstruction<TypeParam> job;
  const auto mesh = pcl::make_shared<pcl::PolygonMesh>();
  job.setInputCloud(cloud);
  job.setFaults(faults);
  job.reconstruct(*mesh);
  ASSERT_EQ(job.getStatus(), SurfaceStatus::Complete) << job.getStatusMessage();
  EXPECT_EQ(job.getPieces().size(), 2U);

  QEMFaultFitter fitter;
  fitter.setInputCloud(cloud);
  fitter.setInputMesh(mesh);
  fitter.setFaults(faults);
  pcl::PolygonMesh fitted;
  fitter.process(fitted);
  EXPECT_EQ(fitter.getStatus(), SurfaceStatus::Complete) << fitter.getStatusMessage();
  EXPECT_GT(fitter.getResult().fitted, 0U);
}

template <typename PointT>
void expectSurface() {
  HoppeMarchingCubes<PointT> cubes;
  cubes.setInputCloud(test::twoLevels<PointT>(10.0));
  pcl::PolygonMesh mesh;
  cubes.reconstruct(mesh);
  EXPECT_EQ(cubes.getStatus(), SurfaceStatus::Complete) << cubes.getStatusMessage();
  EXPECT_GT(mesh.polygons.size(), 100U);
}

TEST(PointTypesWithNormals, AreTakenByMarchingCubes) {
  expectSurface<pcl::PointNormal>();
  expectSurface<pcl::PointXYZINormal>();
  expectSurface<pcl::PointXYZRGBNormal>();
}

/// A fitter that is given no normals finds them, and comes to the same places.
TEST(FitterWithoutNormals, FindsThem) {
  const auto faults = test::uprightFault();
  const auto cloud = test::twoLevels<pcl::PointNormal>();
  HoppeMarchingCubes<pcl::PointNormal> cubes;
  cubes.setInputCloud(cloud);
  cubes.setFaults(faults);
  const auto mesh = pcl::make_shared<pcl::PolygonMesh>();
  cubes.reconstruct(*mesh);
  QEMFaultFitter fitter;
  fitter.setInputMesh(mesh);
  fitter.setFaults(faults);
  const auto fitted = [&] {
    pcl::PolygonMesh out;
    fitter.process(out);
    pcl::PointCloud<pcl::PointXYZ> vertices;
    pcl::fromPCLPointCloud2(out.cloud, vertices);
    return vertices;
  };
  fitter.setInputCloud(cloud);
  const auto with = fitted();
  fitter.setInputCloud(test::twoLevels<pcl::PointXYZ>());
  const auto without = fitted();
  ASSERT_EQ(with.size(), without.size());
  ASSERT_GT(with.size(), 1000U);
  for (std::size_t v = 0; v < with.size(); ++v)
    EXPECT_LT((with[v].getVector3fMap() - without[v].getVector3fMap()).norm(), 0.01F);
}

/// Half of the points lie 1 too high, and are left out by the indices.
TEST(FitterWithIndices, UsesTheirPointsAlone) {
  const auto faults = test::uprightFault();
  auto cloud = test::twoLevels<pcl::PointNormal>();
  HoppeMarchingCubes<pcl::PointNormal> cubes;
  cubes.setInputCloud(cloud);
  cubes.setFaults(faults);
  const auto mesh = pcl::make_shared<pcl::PolygonMesh>();
  cubes.reconstruct(*mesh);
  auto chosen = pcl::make_shared<pcl::Indices>();
  for (std::size_t i = 0; i < cloud->size(); ++i)
    if (i % 2 == 0)
      chosen->push_back(static_cast<pcl::index_t>(i));
    else
      (*cloud)[i].z += 1.0F;
  QEMFaultFitter fitter;
  fitter.setInputCloud(cloud);
  fitter.setInputMesh(mesh);
  fitter.setFaults(faults);
  fitter.setIndices(chosen);
  EXPECT_EQ(fitter.getIndices(), chosen);
  const auto highest = [&] {
    pcl::PolygonMesh out;
    fitter.process(out);
    pcl::PointCloud<pcl::PointXYZ> vertices;
    pcl::fromPCLPointCloud2(out.cloud, vertices);
    float z = -100.0F;
    for (const pcl::PointXYZ& v : vertices)
      z = std::max(z, v.z);
    return z;
  };
  EXPECT_LT(highest(), 2.05F);
  fitter.setIndices(pcl::IndicesConstPtr());
  EXPECT_GT(highest(), 2.2F) << "all points";
  chosen->push_back(static_cast<pcl::index_t>(cloud->size()));
  fitter.setIndices(chosen);
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  pcl::PolygonMesh out;
  fitter.process(out);
  EXPECT_EQ(fitter.getStatus(), SurfaceStatus::Failed);
}

} // namespace
} // namespace graben
