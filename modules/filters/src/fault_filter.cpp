#include "graben/filters/impl/fault_filter.hpp"

#include <pcl/impl/instantiate.hpp>
#include <pcl/point_types.h>

PCL_INSTANTIATE(FaultFilter,
                (pcl::PointXYZ)(pcl::PointXYZI)(pcl::PointXYZL)(pcl::PointXYZRGB)(pcl::PointXYZRGBA)
                (pcl::PointNormal)(pcl::PointXYZINormal)(pcl::PointXYZRGBNormal))
