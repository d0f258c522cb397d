#include "graben/features/impl/fault_constrained_normal_estimation.hpp"

#include <pcl/impl/instantiate.hpp>
#include <pcl/point_types.h>

PCL_INSTANTIATE_PRODUCT(FaultConstrainedNormalEstimation,
                        ((pcl::PointXYZ)(pcl::PointXYZI)(pcl::PointXYZL)(pcl::PointXYZRGB)(pcl::PointXYZRGBA)(pcl::PointNormal)(pcl::PointXYZINormal)(
                          pcl::PointXYZRGBNormal))((pcl::Normal)(pcl::PointNormal)(pcl::PointXYZINormal)(pcl::PointXYZRGBNormal)))
