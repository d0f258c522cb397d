#pragma once

#include "graben/core/export.h"
#include "graben/mesh/triangle_mesh.h"

#include <vector>

GRABEN_EXPORT_BEGIN
namespace graben {

/// A line of equal value on a surface.
struct ContourLine {
  double value = 0.0;
  Points points;       ///< on the triangles' edges; closed: the first point is repeated
  bool closed = false;
};

/// The lines where a per-vertex value equals one of the levels, as long as they can be joined.
///
/// A vertex exactly at a level counts as above it, so lines neither branch nor stop there; at the border of a piece they end.
/// \param[in] values one per vertex; triangles with a value that is not finite are left out
/// \param[in] levels in rising order
/// In the order of the levels; O(n log n), deterministic. \throw InvalidInputError if there is not one value per vertex
std::vector<ContourLine> contourLines(const TriangleMesh& mesh, const std::vector<double>& values, const std::vector<double>& levels);

} // namespace graben
GRABEN_EXPORT_END
