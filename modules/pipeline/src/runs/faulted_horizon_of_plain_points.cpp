#include "graben/pipeline/impl/faulted_horizon_reconstruction.hpp"

#include <pcl/impl/instantiate.hpp>

PCL_INSTANTIATE(FaultedHorizonReconstruction, (pcl::PointXYZ)(pcl::PointXYZI)(pcl::PointXYZL)(pcl::PointXYZRGB)(pcl::PointXYZRGBA))
