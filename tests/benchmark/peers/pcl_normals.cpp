// pcl::NormalEstimationOMP alone: the points with normals, no surface.
#include "pcl_cloud.h"

namespace {

void estimate(const graben::peer::Arguments& arguments, const graben::peer::Cloud& cloud, graben::peer::Mesh& mesh) {
  const auto points = graben::peer::withNormals(arguments, cloud);
  mesh.vertices = cloud.points;
  mesh.normals.reserve(points->size());
  for (const pcl::PointNormal& p : *points)
    mesh.normals.push_back({p.normal_x, p.normal_y, p.normal_z});
}

} // namespace

int main(int argc, char** argv) { return graben::peer::run(argc, argv, false, estimate); }
