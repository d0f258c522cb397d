#pragma once

#include "graben/core/export.h"
#include "graben/features/neighbor_grid.h"

GRABEN_EXPORT_BEGIN
namespace graben {

/// How picks lie: densely in all directions, or along lines (seismic lines, contours) with nothing between them.
struct PickLayout {
  bool along_lines = false;    ///< false: dense in all directions, and the rest is 0
  double along = 0.0;          ///< median distance from pick to pick along the lines, in the picks' units
  double line_distance = 0.0;  ///< median of line_distances over the picks on lines
  double farthest_lines = 0.0; ///< 95 % of the picks on lines have no greater distance to the next lines
  double share = 0.0;          ///< of all picks lies on lines
  std::vector<float> line_distances; ///< for each point of the cloud how far the next lines are, about; 0 where picks lie dense in all directions
};

/// Finds out how picks lie, place by place and at all scales at once.
///
/// Among points that lie along a line their number grows with the distance, on a surface with its square: where it does not grow by three when the distance
/// doubles, picks lie along lines. The cloud is thinned step by step (cells that grow by the root of two) until it does: then the cells have the size that
/// makes the thinned cloud dense in all directions, and the lines are about five cells apart. Where all picks are dense, a look at 8,000 of them does.
/// Lines far from everything, which no scale makes a surface, take the line distance of the nearest picks that have one.
/// O(n log n) in the picks on lines; the same for any number of threads.
/// \param[in] threads 0: one per processor
PickLayout pickLayout(const NeighborGrid& grid, unsigned threads = 0);

} // namespace graben
GRABEN_EXPORT_END
