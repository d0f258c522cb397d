#define PCL_NO_PRECOMPILE

#include <pcl/pcl_macros.h>
#include <pcl/point_types.h>
#include <pcl/register_point_struct.h>

/// A pick with the age of its survey.
struct SurveyPoint {
  PCL_ADD_POINT4D;
  PCL_ADD_NORMAL4D;
  float age = 0.0F;
  PCL_MAKE_ALIGNED_OPERATOR_NEW
};

POINT_CLOUD_REGISTER_POINT_STRUCT(SurveyPoint, (float, x, x)(float, y, y)(float, z, z)(float, normal_x, normal_x)(float, normal_y, normal_y)(
                                                 float, normal_z, normal_z)(float, age, age))

/// The same as the estimation's output, which PCL wants a curvature in.
struct SurveyNormal {
  PCL_ADD_NORMAL4D;
  float curvature = 0.0F;
  PCL_MAKE_ALIGNED_OPERATOR_NEW
};

POINT_CLOUD_REGISTER_POINT_STRUCT(SurveyNormal, (float, normal_x, normal_x)(float, normal_y, normal_y)(float, normal_z, normal_z)(float, curvature, curvature))

#include "two_levels.h"

#include "graben/features/fault_constrained_normal_estimation.h"
#include "graben/filters/fault_zone.h"
#include "graben/filters/wrong_side_filter.h"
#include "graben/pipeline/faulted_horizon_reconstruction.h"
#include "graben/surface/hoppe_marching_cubes.h"
#include "graben/surface/qem_fault_fitter.h"

namespace graben {
namespace {

class OwnPointType : public testing::Test {
protected:
  OwnPointType() {
    for (SurveyPoint& p : *cloud_)
      p.age = p.x < 0.25F ? 1994.0F : 2021.0F;
  }
  /// Vertices with the age of the other side's survey, or none.
  static std::size_t wronglyAged(const pcl::PointCloud<SurveyPoint>& vertices) {
    std::size_t wrong = 0;
    for (const SurveyPoint& v : vertices)
      wrong += v.age != (v.z > 0.0F ? 1994.0F : 2021.0F) ? 1U : 0U;
    return wrong;
  }

  pcl::PointCloud<SurveyPoint>::Ptr cloud_ = test::twoLevels<SurveyPoint>(10.0);
  std::shared_ptr<const FaultNetwork> faults_ = test::uprightFault();
  pcl::PointCloud<SurveyPoint> vertices_;
  std::vector<pcl::Vertices> polygons_;
};

TEST_F(OwnPointType, HasNormals) {
  FaultConstrainedNormalEstimation<SurveyPoint, SurveyNormal> normals;
  normals.setInputCloud(cloud_);
  normals.setFaults(faults_);
  pcl::PointCloud<SurveyNormal> out;
  normals.compute(out);
  EXPECT_EQ(normals.getStatus(), NormalEstimationStatus::Complete) << normals.getStatusMessage();
  for (const SurveyNormal& n : out)
    EXPECT_GT(n.normal_z, 0.99F);
}

TEST_F(OwnPointType, IsFiltered) {
  FaultZone<SurveyPoint> zone;
  WrongSidePicks<SurveyPoint> wrong;
  zone.setInputCloud(cloud_);
  zone.setFaults(faults_);
  wrong.setInputCloud(cloud_);
  wrong.setFaults(faults_);
  pcl::PointCloud<SurveyPoint> near, good;
  zone.filter(near);
  wrong.filter(good);
  EXPECT_LT(near.size(), cloud_->size());
  EXPECT_GT(near.size(), 0U);
  EXPECT_EQ(good.size(), cloud_->size());
}

TEST_F(OwnPointType, BecomesASurface) {
  HoppeMarchingCubes<SurveyPoint> cubes;
  cubes.setInputCloud(cloud_);
  cubes.setFaults(faults_);
  cubes.reconstruct(vertices_, polygons_);
  EXPECT_EQ(cubes.getStatus(), SurfaceStatus::Complete) << cubes.getStatusMessage();
  EXPECT_GT(vertices_.size(), 1000U);
  EXPECT_EQ(wronglyAged(vertices_), 0U);
}

TEST_F(OwnPointType, DoesTheWholeJobAndIsFittedTo) {
  FaultedHorizonReconstruction<SurveyPoint> job;
  job.setInputCloud(cloud_);
  job.setFaults(faults_);
  job.reconstruct(vertices_, polygons_);
  EXPECT_EQ(job.getStatus(), SurfaceStatus::Complete) << job.getStatusMessage();
  EXPECT_GT(vertices_.size(), 1000U);
  EXPECT_EQ(wronglyAged(vertices_), 0U);
  QEMFaultFitter fitter;
  fitter.setInputCloud(cloud_);
  EXPECT_EQ(fitter.getInputCloud<SurveyPoint>(), cloud_);
}

} // namespace
} // namespace graben
