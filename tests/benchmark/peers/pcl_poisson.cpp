// pcl::NormalEstimationOMP + pcl::Poisson, the finest cells of its octree at most a fifth larger than the voxel size.
#include "pcl_cloud.h"

#include <pcl/surface/poisson.h>

#include <algorithm>
#include <cmath>

namespace {

using namespace graben::peer;

constexpr double kCoarser = 1.2;

void reconstruct(const Arguments& arguments, const Cloud& cloud, Mesh& mesh) {
  const auto points = withNormals(arguments, cloud);
  Stopwatch watch;
  pcl::Poisson<pcl::PointNormal> poisson;
  poisson.setInputCloud(points);
  const double width = poisson.getScale() * std::max({cloud.size[0], cloud.size[1], cloud.size[2]});
  poisson.setDepth(std::max(1, static_cast<int>(std::ceil(std::log2(width / arguments.voxel / kCoarser)))));
  poisson.setThreads(arguments.threads);
  pcl::PointCloud<pcl::PointNormal> vertices;
  std::vector<pcl::Vertices> polygons;
  poisson.reconstruct(vertices, polygons);
  append(vertices, polygons, mesh);
  watch.lap("surface");
}

} // namespace

int main(int argc, char** argv) { return run(argc, argv, true, reconstruct); }
