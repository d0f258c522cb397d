#pragma once

#include "graben/pipeline/horizon_reconstruction.h"

#include <pcl/PCLPointCloud2.h>

#include <vector>

namespace graben {

/// A surface as a PCL cloud of its vertices and the triangles over them.
struct CloudSurface {
  pcl::PCLPointCloud2 cloud;
  std::vector<Triangle> faces;
};

/// Reconstructs the surface a cloud was taken from, without faults.
///
/// A vertex has all fields of the cloud: x y z in the type the cloud has them, normal_x normal_y normal_z of the surface (added
/// as float32 where the cloud has none), the rest as the nearest finite point has them.
/// \throw InvalidInputError as HorizonReconstruction, or if x, y or z is missing or no floating point number
CloudSurface reconstructCloud(const pcl::PCLPointCloud2& cloud, const ReconstructionOptions& options);

} // namespace graben
