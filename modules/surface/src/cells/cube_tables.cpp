#include "cube_tables.h"

#include <pcl/point_types.h>
#include <pcl/surface/marching_cubes.h>

namespace graben {

const int (&cubeTriangles())[256][16] { return pcl::triTable; }

} // namespace graben
