// Open3D's normals from 15 neighbours, turned, and ball pivoting with balls of one and two voxels' radius.
#include "peer.h"

#include <open3d/geometry/KDTreeSearchParam.h>
#include <open3d/geometry/PointCloud.h>
#include <open3d/geometry/TriangleMesh.h>

namespace {

using namespace graben::peer;

constexpr int kNeighbors = 15;

void reconstruct(const Arguments& arguments, const Cloud& cloud, Mesh& mesh) {
  Stopwatch watch;
  open3d::geometry::PointCloud points;
  points.points_.reserve(cloud.points.size());
  for (const Point& p : cloud.points)
    points.points_.emplace_back(p[0], p[1], p[2]);
  points.EstimateNormals(open3d::geometry::KDTreeSearchParamKNN(kNeighbors));
  const Point view = viewpoint(arguments, cloud);
  points.OrientNormalsTowardsCameraLocation(Eigen::Vector3d(view[0], view[1], view[2]));
  if (arguments.object)
    for (Eigen::Vector3d& normal : points.normals_)
      normal = -normal;
  watch.lap("normals");
  const auto surface =
    open3d::geometry::TriangleMesh::CreateFromPointCloudBallPivoting(points, {arguments.voxel, 2 * arguments.voxel});
  for (const Eigen::Vector3d& v : surface->vertices_)
    mesh.vertices.push_back({static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())});
  for (const Eigen::Vector3i& t : surface->triangles_)
    mesh.triangles.push_back({t.x(), t.y(), t.z()});
  watch.lap("surface");
}

} // namespace

int main(int argc, char** argv) { return run(argc, argv, true, reconstruct); }
