#include "graben/surface/impl/hoppe_marching_cubes.hpp"

#include <pcl/impl/instantiate.hpp>
#include <pcl/point_types.h>

PCL_INSTANTIATE(HoppeMarchingCubes,
                (pcl::PointNormal)(pcl::PointXYZRGBNormal)(pcl::PointXYZINormal))
