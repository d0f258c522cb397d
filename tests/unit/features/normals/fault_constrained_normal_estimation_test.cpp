#include "clouds.h"
#include "graben/features/fault_constrained_normal_estimation.h"

#include <gtest/gtest.h>
#include <pcl/console/print.h>
#include <pcl/point_types.h>

#include <algorithm>
#include <cstring>
#include <limits>

namespace graben {
namespace {

using Cloud = pcl::PointCloud<pcl::PointXYZ>;
using Normals = pcl::PointCloud<pcl::Normal>;
using Estimation = FaultConstrainedNormalEstimation<pcl::PointXYZ, pcl::Normal>;

Cloud::Ptr toCloud(const Points& points) {
  Cloud::Ptr cloud(new Cloud);
  for (const Vector3& p : points)
    cloud->push_back(pcl::PointXYZ(static_cast<float>(p.x()), static_cast<float>(p.y()),
                                   static_cast<float>(p.z())));
  return cloud;
}

Vector3 normalOf(const pcl::Normal& n) {
  return n.getNormalVector3fMap().cast<double>();
}

bool sameBits(float a, float b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

bool same(const Normals& a, const Normals& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const pcl::Normal& m, const pcl::Normal& n) {
                      return sameBits(m.normal_x, n.normal_x) && sameBits(m.normal_y, n.normal_y) &&
                             sameBits(m.normal_z, n.normal_z) && sameBits(m.curvature, n.curvature);
                    });
}

class NormalEstimationTest : public testing::Test {
protected:
  void SetUp() override {
    level_ = pcl::console::getVerbosityLevel();
    pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  }
  void TearDown() override { pcl::console::setVerbosityLevel(level_); }

private:
  pcl::console::VERBOSITY_LEVEL level_ = pcl::console::L_INFO;
};

TEST_F(NormalEstimationTest, WorksThroughTheBaseClassWithoutAnyParameter) {
  const test::ThrownFold fold;
  auto own = pcl::make_shared<Estimation>();
  own->setFaults(std::make_shared<FaultNetwork>(fold.faults));
  const pcl::NormalEstimationOMP<pcl::PointXYZ, pcl::Normal>::Ptr estimation = own;
  const Cloud::Ptr cloud = toCloud(fold.points);
  cloud->header.frame_id = "survey";
  estimation->setInputCloud(cloud);
  Normals normals;
  estimation->compute(normals);
  ASSERT_EQ(normals.size(), cloud->size());
  EXPECT_EQ(normals.header.frame_id, "survey");
  EXPECT_TRUE(normals.is_dense);
  EXPECT_EQ(own->getStatus(), NormalEstimationStatus::Complete);
  EXPECT_GT(own->getUsedRho(), 10.0);
  for (std::size_t i = 0; i < normals.size(); ++i) {
    ASSERT_LT(test::lineAngle(normalOf(normals[i]), fold.normalAt(i)), 0.01);
    ASSERT_GT(normals[i].normal_z, 0.0F);
    ASSERT_NEAR(normals[i].curvature, 0.0F, 1e-6F);
  }
  own->setFaults(nullptr);
  own->setRho(std::numeric_limits<double>::infinity());
  estimation->compute(normals);
  double worst = 0.0;
  for (std::size_t i = 0; i < normals.size(); ++i)
    worst = std::max(worst, test::lineAngle(normalOf(normals[i]), fold.normalAt(i)));
  EXPECT_GT(worst, 20.0) << "without the faults and the limit the fault must spoil normals";
}

TEST_F(NormalEstimationTest, IndicesGiveThoseRowsOfTheWhole) {
  const Cloud::Ptr cloud = toCloud(test::wavySheet(2000, 1000.0, 1.0));
  pcl::IndicesPtr indices(new pcl::Indices{1999, 3, 3, 500});
  for (const NormalOrientation orientation :
       {NormalOrientation::SpanningTree, NormalOrientation::UpAxis, NormalOrientation::Viewpoint}) {
    Estimation estimation;
    estimation.setInputCloud(cloud);
    estimation.setOrientation(orientation);
    Normals all, some;
    estimation.compute(all);
    estimation.setIndices(indices);
    estimation.compute(some);
    ASSERT_EQ(some.size(), 4U);
    EXPECT_EQ(some.height, 1U);
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_EQ(normalOf(some[i]), normalOf(all[static_cast<std::size_t>((*indices)[i])]));
  }
}

TEST_F(NormalEstimationTest, SearchSurface) {
  const test::PlanarGrid grid = {10.0, 0.0, 300.0, 300.0, 0.4, 0.2, -100.0};
  Points surface;
  grid.appendTo(surface);
  Estimation estimation;
  estimation.setSearchSurface(toCloud(surface));
  estimation.setInputCloud(toCloud({{150.0, 151.0, -8.0}, {4.0, 4.0, -90.0}}));
  Normals normals;
  estimation.compute(normals);
  ASSERT_EQ(normals.size(), 2U);
  for (const pcl::Normal& normal : normals) {
    EXPECT_LT(test::lineAngle(normalOf(normal), grid.normal()), 0.01);
    EXPECT_GT(normal.normal_z, 0.0F);
  }
}

TEST_F(NormalEstimationTest, NaNInNaNOut) {
  Points points = test::wavySheet(1000, 1000.0, 1.0);
  const Cloud::Ptr cloud = toCloud(points);
  (*cloud)[10].y = std::numeric_limits<float>::quiet_NaN();
  for (const bool dense : {false, true}) { // a cloud that says it has none may lie
    cloud->is_dense = dense;
    Estimation estimation;
    estimation.setInputCloud(cloud);
    Normals normals;
    estimation.compute(normals);
    EXPECT_FALSE(normals.is_dense);
    EXPECT_EQ(estimation.getStatus(), NormalEstimationStatus::Incomplete);
    for (std::size_t i = 0; i < normals.size(); ++i) {
      ASSERT_EQ(std::isfinite(normals[i].normal_z), i != 10);
      ASSERT_EQ(std::isfinite(normals[i].curvature), i != 10);
    }
  }
}

TEST_F(NormalEstimationTest, OrganizedCloudKeepsItsShape) {
  const Cloud::Ptr cloud = toCloud(test::wavySheet(1200, 1000.0, 1.0));
  cloud->width = 40;
  cloud->height = 30;
  Estimation estimation;
  estimation.setInputCloud(cloud);
  Normals normals;
  estimation.compute(normals);
  EXPECT_EQ(normals.width, 40U);
  EXPECT_EQ(normals.height, 30U);
}

TEST_F(NormalEstimationTest, NothingToWorkOnFailsWithAnEmptyCloud) {
  Normals normals;
  normals.resize(3);
  Estimation none;
  EXPECT_EQ(none.getStatus(), NormalEstimationStatus::NotRun);
  none.compute(normals);
  EXPECT_TRUE(normals.empty());
  EXPECT_EQ(none.getStatus(), NormalEstimationStatus::Failed);
  EXPECT_FALSE(none.getStatusMessage().empty());

  Estimation null, empty, outside, both;
  null.setInputCloud(nullptr);
  empty.setInputCloud(toCloud({}));
  outside.setInputCloud(toCloud(test::wavySheet(100, 100.0, 1.0)));
  outside.setIndices(pcl::IndicesPtr(new pcl::Indices{0, 100}));
  both.setInputCloud(toCloud(test::wavySheet(100, 100.0, 1.0)));
  both.setKSearch(10);
  both.setRadiusSearch(10.0);
  for (Estimation* estimation : {&null, &empty, &outside, &both}) {
    normals.resize(3);
    estimation->compute(normals);
    EXPECT_TRUE(normals.empty());
    EXPECT_EQ(estimation->getStatus(), NormalEstimationStatus::Failed);
  }
}

TEST_F(NormalEstimationTest, WhatHasNoPlaneFailsWithNaN) {
  const float nothing = std::numeric_limits<float>::quiet_NaN();
  const Cloud::Ptr all_nan(new Cloud(5, 1, pcl::PointXYZ(nothing, nothing, nothing)));
  for (const Cloud::Ptr& cloud :
       {toCloud({{1, 2, 3}}), toCloud(Points(50, Vector3(1, 2, 3))), all_nan}) {
    Estimation estimation;
    estimation.setInputCloud(cloud);
    Normals normals;
    estimation.compute(normals);
    ASSERT_EQ(normals.size(), cloud->size());
    EXPECT_FALSE(normals.is_dense);
    EXPECT_EQ(estimation.getStatus(), NormalEstimationStatus::Failed);
    for (const pcl::Normal& normal : normals)
      EXPECT_TRUE(std::isnan(normal.normal_x) && std::isnan(normal.curvature));
  }
}

TEST_F(NormalEstimationTest, OrientationByAxisAndByViewpoint) {
  const Cloud::Ptr cloud = toCloud(test::wavySheet(1000, 1000.0, 1.0));
  Normals normals;
  Estimation estimation;
  estimation.setInputCloud(cloud);
  const auto expectAll = [&](bool up) {
    estimation.compute(normals);
    for (const pcl::Normal& normal : normals)
      ASSERT_EQ(normal.normal_z > 0.0F, up);
  };
  expectAll(true);
  estimation.setUpAxis(Eigen::Vector3f(0.0F, 0.0F, -1.0F));
  expectAll(false);
  estimation.setOrientation(NormalOrientation::UpAxis);
  expectAll(false);
  estimation.setOrientation(NormalOrientation::Viewpoint);
  estimation.setViewPoint(0.0F, 0.0F, 1e6F);
  expectAll(true);
  estimation.setViewPoint(0.0F, 0.0F, -1e6F);
  expectAll(false);
}

TEST_F(NormalEstimationTest, AgreesWithPclAwayFromFaults) {
  const Cloud::Ptr cloud = toCloud(test::wavySheet(3000, 1000.0, 1.0));
  pcl::NormalEstimationOMP<pcl::PointXYZ, pcl::Normal> base;
  Estimation own;
  own.setRho(std::numeric_limits<double>::infinity());
  Normals expected, normals;
  for (const bool by_radius : {false, true}) {
    for (pcl::NormalEstimationOMP<pcl::PointXYZ, pcl::Normal>* estimation :
         {&base, static_cast<decltype(&base)>(&own)}) {
      estimation->setInputCloud(cloud);
      estimation->setKSearch(by_radius ? 0 : 20);
      estimation->setRadiusSearch(by_radius ? 60.0 : 0.0);
      estimation->compute(estimation == &base ? expected : normals);
    }
    for (std::size_t i = 0; i < normals.size(); ++i) {
      if (!std::isfinite(expected[i].normal_x))
        continue;
      ASSERT_LT(test::lineAngle(normalOf(normals[i]), normalOf(expected[i])), 0.1);
      ASSERT_NEAR(normals[i].curvature, expected[i].curvature, 1e-3F);
    }
  }
}

TEST_F(NormalEstimationTest, PointNormalsInAndOut) {
  pcl::PointCloud<pcl::PointNormal>::Ptr cloud(new pcl::PointCloud<pcl::PointNormal>);
  for (const Vector3& p : test::wavySheet(500, 1000.0, 1.0)) {
    pcl::PointNormal point;
    point.getVector3fMap() = p.cast<float>();
    cloud->push_back(point);
  }
  FaultConstrainedNormalEstimation<pcl::PointNormal, pcl::PointNormal> estimation;
  estimation.setInputCloud(cloud);
  pcl::PointCloud<pcl::PointNormal> normals;
  estimation.compute(normals);
  for (const pcl::PointNormal& normal : normals)
    ASSERT_GT(normal.normal_z, 0.0F);
}

TEST_F(NormalEstimationTest, TheSameBytesForAnyNumberOfThreads) {
  Estimation estimation;
  estimation.setInputCloud(toCloud(test::wavySheet(20000, 1000.0, 2.0)));
  Normals one, four;
  estimation.setNumberOfThreads(1);
  estimation.compute(one);
  estimation.setNumberOfThreads(4);
  estimation.compute(four);
  EXPECT_TRUE(same(one, four));
}

} // namespace
} // namespace graben
