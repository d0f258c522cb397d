#pragma once

namespace graben {

/// pcl::triTable; kept behind a function so that only one file includes PCL's header.
const int (&cubeTriangles())[256][16];

} // namespace graben
