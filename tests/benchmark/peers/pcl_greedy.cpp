// pcl::NormalEstimationOMP + pcl::GreedyProjectionTriangulation with the angles of PCL's tutorial, edges up to 2.5 voxels.
#include "pcl_cloud.h"

#include <pcl/search/kdtree.h>
#include <pcl/surface/gp3.h>

namespace {

using namespace graben::peer;

void reconstruct(const Arguments& arguments, const Cloud& cloud, Mesh& mesh) {
  const auto points = withNormals(arguments, cloud);
  Stopwatch watch;
  pcl::GreedyProjectionTriangulation<pcl::PointNormal> greedy;
  greedy.setInputCloud(points);
  greedy.setSearchMethod(pcl::make_shared<pcl::search::KdTree<pcl::PointNormal>>());
  greedy.setSearchRadius(2.5 * arguments.voxel);
  greedy.setMu(2.5);
  greedy.setMaximumNearestNeighbors(100);
  greedy.setMaximumSurfaceAngle(M_PI / 4);
  greedy.setMinimumAngle(M_PI / 18);
  greedy.setMaximumAngle(2 * M_PI / 3);
  greedy.setNormalConsistency(true);
  std::vector<pcl::Vertices> polygons;
  greedy.reconstruct(polygons);
  append(*points, polygons, mesh);
  watch.lap("surface");
}

} // namespace

int main(int argc, char** argv) { return run(argc, argv, true, reconstruct); }
