#include <graben/graben.h>
#include <graben/visualization/section.h>

#include <iostream>

int main() {
  graben::TriangleMesh wall;
  wall.vertices = {{0.2, -20, -10}, {0.2, 20, -10}, {0.2, 20, 10}, {0.2, -20, 10}};
  wall.triangles = {{0, 1, 2}, {0, 2, 3}};
  auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointXYZRGB>>();
  for (int i = -20; i <= 20; ++i)
    for (int j = -20; j <= 20; ++j) {
      pcl::PointXYZRGB p(i < 1 ? 200 : 0, 0, 0);
      p.x = 0.5F * static_cast<float>(i);
      p.y = 0.5F * static_cast<float>(j);
      p.z = i < 1 ? 2.0F : -2.0F;
      cloud->push_back(p);
    }
  graben::FaultedHorizonReconstruction<pcl::PointXYZRGB> job;
  job.setInputCloud(cloud);
  job.setFaultInputs({{"wall", wall}});
  pcl::PolygonMesh mesh;
  job.reconstruct(mesh);
  const bool right = job.getPieces().size() == 2 && graben::cutMesh(wall, {{-1, 0, 0}, {1, 0, 0}}).size() == 1;
  std::cout << (right ? "graben works\n" : "graben gave a wrong answer: " + job.getStatusMessage() + "\n");
  return right ? 0 : 1;
}
