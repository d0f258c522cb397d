#pragma once

#include "graben/core/export.h"
#include "graben/mesh/triangle_mesh.h"

#include <cstddef>

GRABEN_EXPORT_BEGIN
namespace graben {

/// Shapes of the triangles of a mesh; all zero for an empty mesh. A degenerate triangle has the
/// angle 0 and an infinite aspect ratio.
struct TriangleQuality {
  std::size_t triangles = 0;
  double smallest_angle_min = 0.0; ///< the least of all triangles' smallest angles, degrees
  double smallest_angle_p1 =
      0.0; ///< 1 % of the triangles have a smallest angle up to this, degrees
  double smallest_angle_median = 0.0; ///< degrees
  double share_below_10_degrees =
      0.0; ///< share of triangles with a smallest angle under 10 degrees, 0 to 1
  double edge_length_median = 0.0; ///< over the sides of all triangles (an inner edge counts
                                   ///< twice), unit of the coordinates
  double aspect_ratio_p99 =
      0.0; ///< longest edge over smallest height, 1 for an equilateral triangle
};

/// \param[in] threads 0: one per processor
/// O(n). \throw InvalidInputError if the mesh is not valid (see validate)
TriangleQuality triangleQuality(const TriangleMesh& mesh, unsigned threads = 0);

} // namespace graben
GRABEN_EXPORT_END
