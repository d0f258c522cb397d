#pragma once

#include "peer.h"

#include <pcl/PolygonMesh.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

namespace graben::peer {

constexpr int kNeighbors = 15; ///< a plane is fitted to, in every peer that fits planes

/// The points with normals of pcl::NormalEstimationOMP, as PCL's tutorial has it, but looking at viewpoint() instead of the origin.
pcl::PointCloud<pcl::PointNormal>::Ptr withNormals(const Arguments& arguments, const Cloud& cloud);

void append(const pcl::PointCloud<pcl::PointNormal>& vertices, const std::vector<pcl::Vertices>& polygons, Mesh& mesh);

} // namespace graben::peer
