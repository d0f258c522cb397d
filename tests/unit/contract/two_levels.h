#pragma once

#include "graben/faults/fault_network.h"

#include <pcl/console/print.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/type_traits.h>

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

namespace graben::test {

/// A level horizon over the square [-20, 20]^2, points every 0.5, thrown by 4 at an upright fault in x = 0.25: 2 in the west, -2 in the east.
template <typename PointT>
typename pcl::PointCloud<PointT>::Ptr twoLevels(double half = 20.0) {
  auto cloud = pcl::make_shared<pcl::PointCloud<PointT>>();
  for (double x = -half; x <= half; x += 0.5)
    for (double y = -half; y <= half; y += 0.5) {
      PointT p;
      p.x = static_cast<float>(x + 0.1 * std::sin(7.0 * x + 3.0 * y));
      p.y = static_cast<float>(y + 0.1 * std::sin(5.0 * x - 4.0 * y));
      p.z = p.x < 0.25F ? 2.0F : -2.0F;
      if constexpr (pcl::traits::has_normal<PointT>::value) {
        p.normal_x = p.normal_y = 0.0F;
        p.normal_z = 1.0F;
      }
      cloud->push_back(p);
    }
  cloud->header.frame_id = "survey";
  return cloud;
}

/// The fault between them, moved by \a away.
inline std::shared_ptr<const FaultNetwork> uprightFault(const Vector3& away = Vector3::Zero()) {
  TriangleMesh wall;
  for (const Vector3& p : {Vector3(0.25, -30, -10), Vector3(0.25, 30, -10), Vector3(0.25, 30, 10), Vector3(0.25, -30, 10)})
    wall.vertices.push_back(p + away);
  wall.triangles = {{0, 1, 2}, {0, 2, 3}};
  return std::make_shared<const FaultNetwork>(std::vector<FaultSurface>{FaultSurface::fromMesh("wall", wall)});
}

/// Faults in the frame of a map, where the cloud is about a local origin.
inline std::shared_ptr<const FaultNetwork> faultOfAnotherFrame() { return uprightFault({461000.0, 5931000.0, 0.0}); }

/// Keeps PCL's messages off the screen.
class Contract : public testing::Test {
protected:
  Contract() : level_(pcl::console::getVerbosityLevel()) { pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS); }
  ~Contract() override { pcl::console::setVerbosityLevel(level_); }

private:
  pcl::console::VERBOSITY_LEVEL level_;
};

} // namespace graben::test
