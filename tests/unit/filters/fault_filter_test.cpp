#include "graben/filters/fault_zone.h"
#include "graben/filters/wrong_side_filter.h"
#include "two_sheets.h"

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <gtest/gtest.h>

#include <limits>

namespace graben {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

template <typename PointT>
typename pcl::PointCloud<PointT>::Ptr cloudOf(const Points& points) {
  auto cloud = pcl::make_shared<pcl::PointCloud<PointT>>();
  for (const Vector3& p : points) {
    PointT point;
    point.getVector3fMap() = p.cast<float>();
    cloud->push_back(point);
  }
  return cloud;
}

/// Two sheets with a wrong-side pick, a smeared one and one that is not finite, in that order at
/// the end.
struct Job {
  Job() {
    wrong = sheets.add(6.0, 3.0, 0.0);
    smeared = sheets.add(0.5, -40.0, 18.0);
    sheets.points.emplace_back(0.0, 0.0, 0.0);
    cloud = cloudOf<pcl::PointXYZ>(sheets.points);
    cloud->back().z = kNaN;
    cloud->is_dense = false;
    faults = std::make_shared<FaultNetwork>(sheets.faults);
  }
  pcl::index_t count() const { return static_cast<pcl::index_t>(cloud->size()); }

  test::TwoSheets sheets;
  Index wrong, smeared;
  pcl::PointCloud<pcl::PointXYZ>::Ptr cloud;
  std::shared_ptr<FaultNetwork> faults;
};

TEST(WrongSideFilter, RemovesFlaggedPicksAndSaysWhy) {
  const Job job;
  WrongSidePicks<pcl::PointXYZ> filter(true);
  EXPECT_EQ(filter.getStatus(), FilterStatus::NotRun);
  filter.setInputCloud(job.cloud);
  filter.setFaults(job.faults);
  pcl::Indices kept;
  filter.filter(kept);
  EXPECT_EQ(filter.getStatus(), FilterStatus::Complete);
  EXPECT_EQ(kept.size(), job.cloud->size() - 3);
  EXPECT_TRUE(std::is_sorted(kept.begin(), kept.end()));
  EXPECT_EQ(*filter.getRemovedIndices(), (pcl::Indices{job.wrong, job.smeared, job.count() - 1}));
  ASSERT_EQ(filter.getReasons().size(), job.cloud->size());
  EXPECT_EQ(filter.getReasons()[static_cast<std::size_t>(job.wrong)], PickReason::WrongSide);
  EXPECT_EQ(filter.getReasons()[static_cast<std::size_t>(job.smeared)], PickReason::Smeared);
  EXPECT_EQ(filter.getResult().wrong_side, 1U);
}

TEST(WrongSideFilter, NegativeKeepsOnlyThemAndNeverWhatIsNotFinite) {
  const Job job;
  WrongSidePicks<pcl::PointXYZ> filter;
  filter.setInputCloud(job.cloud);
  filter.setFaults(job.faults);
  filter.setNegative(true);
  pcl::Indices kept;
  filter.filter(kept);
  EXPECT_EQ(kept, (pcl::Indices{job.wrong, job.smeared}));
  EXPECT_TRUE(filter.getRemovedIndices()->empty()) << "not asked for";
}

TEST(WrongSideFilter, IndicesChooseButAllPointsAreEvidence) {
  const Job job;
  WrongSidePicks<pcl::PointXYZ> filter(true);
  filter.setInputCloud(job.cloud);
  filter.setFaults(job.faults);
  const auto chosen = pcl::make_shared<pcl::Indices>(pcl::Indices{job.wrong, 5, 3});
  filter.setIndices(chosen);
  pcl::Indices kept;
  filter.filter(kept);
  EXPECT_EQ(kept, (pcl::Indices{5, 3})) << "in the order asked for";
  EXPECT_EQ(*filter.getRemovedIndices(), pcl::Indices{job.wrong});
}

TEST(WrongSideFilter, KeepsACloudOrganized) {
  const Job job;
  WrongSidePicks<pcl::PointXYZ> filter(true);
  filter.setInputCloud(job.cloud);
  filter.setFaults(job.faults);
  filter.setKeepOrganized(true);
  pcl::PointCloud<pcl::PointXYZ> output;
  filter.filter(output);
  ASSERT_EQ(output.size(), job.cloud->size());
  EXPECT_FALSE(output.is_dense);
  EXPECT_TRUE(std::isnan(output[static_cast<std::size_t>(job.wrong)].x));
  EXPECT_EQ(output[0].x, (*job.cloud)[0].x);
}

TEST(WrongSideFilter, FailureRemovesEverythingAndSaysSo) {
  const Job job;
  WrongSidePicks<pcl::PointXYZ> filter(true);
  filter.setInputCloud(job.cloud);
  filter.setFaults(job.faults);
  filter.setBand(-1.0);
  pcl::Indices kept = {1, 2};
  filter.filter(kept);
  EXPECT_TRUE(kept.empty());
  EXPECT_EQ(filter.getStatus(), FilterStatus::Failed);
  EXPECT_FALSE(filter.getStatusMessage().empty());
  EXPECT_TRUE(filter.getReasons().empty());
  EXPECT_EQ(filter.getRemovedIndices()->size(), job.cloud->size());
  filter.setBand(0.0);
  filter.setIndices(pcl::make_shared<pcl::Indices>(pcl::Indices{0, job.count()}));
  filter.filter(kept);
  EXPECT_TRUE(kept.empty());
  EXPECT_EQ(filter.getStatus(), FilterStatus::Failed);
}

TEST(WrongSideFilter, WithoutFaultsAllFinitePointsStay) {
  const Job job;
  WrongSidePicks<pcl::PointXYZ> filter;
  filter.setInputCloud(job.cloud);
  pcl::Indices kept;
  filter.filter(kept);
  EXPECT_EQ(kept.size(), job.cloud->size() - 1);
}

TEST(WrongSideFilter, TakesOtherPointTypes) {
  const Job job;
  WrongSidePicks<pcl::PointNormal> normals;
  normals.setInputCloud(cloudOf<pcl::PointNormal>(job.sheets.points));
  normals.setFaults(job.faults);
  WrongSidePicks<pcl::PointXYZI> intensities;
  intensities.setInputCloud(cloudOf<pcl::PointXYZI>(job.sheets.points));
  intensities.setFaults(job.faults);
  pcl::PointCloud<pcl::PointNormal> first;
  normals.filter(first);
  pcl::PointCloud<pcl::PointXYZI> second;
  intensities.filter(second);
  EXPECT_EQ(first.size(), job.sheets.points.size() - 2);
  EXPECT_EQ(second.size(), first.size());
}

TEST(FaultZoneFilter, KeepsWhatIsWithinTheWidth) {
  const Job job;
  FaultZone<pcl::PointXYZ> filter(true);
  filter.setInputCloud(job.cloud);
  filter.setFaults(job.faults);
  filter.setWidth(16.0);
  pcl::Indices kept;
  filter.filter(kept);
  EXPECT_EQ(kept.size(), 4U * 41U + 2U);
  for (const pcl::index_t i : kept)
    EXPECT_LE(std::abs((*job.cloud)[static_cast<std::size_t>(i)].x), 16.0F);
  EXPECT_EQ(kept.size() + filter.getRemovedIndices()->size(), job.cloud->size());
  EXPECT_FLOAT_EQ(static_cast<float>(filter.getDistances()[static_cast<std::size_t>(job.wrong)]),
                  6.0F);
  filter.setNegative(true);
  pcl::Indices away;
  filter.filter(away);
  EXPECT_EQ(away.size(), job.cloud->size() - kept.size() - 1)
      << "the point not finite is in neither";
}

TEST(FaultZoneFilter, ChoosesItsWidthAndRejectsWrongOnes) {
  const Job job;
  FaultZone<pcl::PointXYZ> filter;
  filter.setInputCloud(job.cloud);
  filter.setFaults(job.faults);
  pcl::Indices kept;
  filter.filter(kept);
  EXPECT_NEAR(filter.getUsedWidth(), 50.0, 8.0);
  EXPECT_EQ(filter.getWidth(), 0.0);
  for (const double bad : {-1.0, std::numeric_limits<double>::quiet_NaN()}) {
    filter.setWidth(bad);
    filter.filter(kept);
    EXPECT_TRUE(kept.empty());
    EXPECT_EQ(filter.getStatus(), FilterStatus::Failed);
    EXPECT_TRUE(filter.getDistances().empty());
  }
}

TEST(FaultZoneFilter, WithoutFaultsOrPointsNoneIsNear) {
  const Job job;
  FaultZone<pcl::PointXYZ> filter;
  filter.setInputCloud(job.cloud);
  pcl::Indices kept;
  filter.filter(kept);
  EXPECT_TRUE(kept.empty());
  EXPECT_EQ(filter.getStatus(), FilterStatus::Complete);
  filter.setFaults(job.faults);
  filter.setInputCloud(pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>());
  filter.filter(kept);
  EXPECT_TRUE(kept.empty());
  EXPECT_EQ(filter.getStatus(), FilterStatus::Complete);
}

} // namespace
} // namespace graben
