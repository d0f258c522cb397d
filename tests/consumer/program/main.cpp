#include <graben/graben.h>
#include <graben/model/model_section.h>
#include <graben/visualization/section.h>

#include <iostream>

int main() {
  graben::TriangleMesh wall;
  wall.vertices = {{0.2, -30, -10}, {0.2, 30, -10}, {0.2, 30, 10}, {0.2, -30, 10}};
  wall.triangles = {{0, 1, 2}, {0, 2, 3}};
  auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointXYZRGB>>();
  for (int i = -40; i <= 40; ++i)
    for (int j = -40; j <= 40; ++j) {
      pcl::PointXYZRGB p;
      p.r = i < 1 ? 200 : 0;
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
  const std::size_t pieces = job.getPieces().size(), segments = graben::cutMesh(wall, {{-1, 0, 0}, {1, 0, 0}}).size();
  std::cout << pieces << " pieces, cut in " << segments << " segments\n";
  return pieces == 2 && segments == 2 ? 0 : 1;
}
