#include "graben/pipeline/impl/faulted_horizon_reconstruction.hpp"

#include <pcl/impl/instantiate.hpp>

PCL_INSTANTIATE(FaultedHorizonReconstruction, (pcl::PointNormal)(pcl::PointXYZINormal)(pcl::PointXYZRGBNormal))
