#include <graben/features/fault_constrained_normal_estimation.h>

#include <iostream>

int main() {
  auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  for (int i = 0; i < 400; ++i)
    cloud->emplace_back(static_cast<float>(i % 20), static_cast<float>(i / 20), 5.0F);
  graben::FaultConstrainedNormalEstimation<pcl::PointXYZ, pcl::Normal> estimation;
  estimation.setInputCloud(cloud);
  pcl::PointCloud<pcl::Normal> normals;
  estimation.compute(normals);
  const bool right = normals.size() == 400 && normals[210].normal_z > 0.99F;
  std::cout << (right ? "normals found\n" : "wrong normals: " + estimation.getStatusMessage() + "\n");
  return right ? 0 : 1;
}
