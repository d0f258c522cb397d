#pragma once

#include "shapes.h"

#include "graben/mesh/conversions.h"

#include <gtest/gtest.h>
#include <pcl/console/print.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

namespace graben::test {

template <typename PointNT = pcl::PointNormal>
typename pcl::PointCloud<PointNT>::Ptr toCloud(const Oriented& o) {
  auto cloud = pcl::make_shared<pcl::PointCloud<PointNT>>();
  cloud->header.frame_id = "survey";
  cloud->header.stamp = 7;
  cloud->resize(o.points.size());
  for (std::size_t i = 0; i < o.points.size(); ++i) {
    (*cloud)[i].getVector3fMap() = o.points[i].cast<float>();
    (*cloud)[i].getNormalVector3fMap() = o.normals[i].cast<float>();
  }
  return cloud;
}

/// Keeps PCL's messages of expected errors off the screen.
class QuietTest : public testing::Test {
protected:
  void SetUp() override {
    level_ = pcl::console::getVerbosityLevel();
    pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  }
  void TearDown() override { pcl::console::setVerbosityLevel(level_); }

private:
  pcl::console::VERBOSITY_LEVEL level_ = pcl::console::L_INFO;
};

inline std::shared_ptr<const FaultNetwork> network(std::vector<FaultSurface> faults) {
  return std::make_shared<FaultNetwork>(std::move(faults));
}

} // namespace graben::test
