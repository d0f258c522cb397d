#include "pcl_cloud.h"

#include <pcl/features/normal_3d_omp.h>
#include <pcl/search/kdtree.h>

namespace graben::peer {

pcl::PointCloud<pcl::PointNormal>::Ptr withNormals(const Arguments& arguments, const Cloud& cloud) {
  auto points = pcl::make_shared<pcl::PointCloud<pcl::PointNormal>>();
  points->reserve(cloud.points.size());
  for (const Point& p : cloud.points)
    points->emplace_back(p[0], p[1], p[2], 0.F, 0.F, 0.F);
  Stopwatch watch;
  pcl::NormalEstimationOMP<pcl::PointNormal, pcl::PointNormal> estimation(static_cast<unsigned>(arguments.threads));
  estimation.setInputCloud(points);
  estimation.setSearchMethod(pcl::make_shared<pcl::search::KdTree<pcl::PointNormal>>());
  estimation.setKSearch(kNeighbors);
  const Point view = viewpoint(arguments, cloud);
  estimation.setViewPoint(view[0], view[1], view[2]);
  estimation.compute(*points);
  if (arguments.object)
    for (pcl::PointNormal& p : *points)
      p.getNormalVector3fMap() *= -1;
  watch.lap("normals");
  return points;
}

void append(const pcl::PointCloud<pcl::PointNormal>& vertices, const std::vector<pcl::Vertices>& polygons, Mesh& mesh) {
  mesh.vertices.reserve(vertices.size());
  for (const pcl::PointNormal& p : vertices)
    mesh.vertices.push_back({p.x, p.y, p.z});
  mesh.triangles.reserve(polygons.size());
  for (const pcl::Vertices& polygon : polygons)
    for (std::size_t i = 2; i < polygon.vertices.size(); ++i)
      mesh.triangles.push_back({static_cast<std::int32_t>(polygon.vertices[0]), static_cast<std::int32_t>(polygon.vertices[i - 1]),
                                static_cast<std::int32_t>(polygon.vertices[i])});
}

} // namespace graben::peer
