#include "graben/filters/impl/wrong_side_filter.hpp"

#include <pcl/impl/instantiate.hpp>
#include <pcl/point_types.h>

PCL_INSTANTIATE(WrongSidePicks,
                (pcl::PointXYZ)(pcl::PointXYZI)(pcl::PointXYZL)(pcl::PointXYZRGB)(pcl::PointXYZRGBA)
                (pcl::PointNormal)(pcl::PointXYZINormal)(pcl::PointXYZRGBNormal))
