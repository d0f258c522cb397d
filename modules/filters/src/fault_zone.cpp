#include "graben/filters/impl/fault_zone.hpp"

#include <pcl/impl/instantiate.hpp>
#include <pcl/point_types.h>

PCL_INSTANTIATE(FaultZone,
                (pcl::PointXYZ)(pcl::PointXYZI)(pcl::PointXYZL)(pcl::PointXYZRGB)(pcl::PointXYZRGBA)
                (pcl::PointNormal)(pcl::PointXYZINormal)(pcl::PointXYZRGBNormal))
