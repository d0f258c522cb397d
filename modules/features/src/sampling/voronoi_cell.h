#pragma once

#include <Eigen/Core>

#include <vector>

namespace graben::detail {

/// What the Voronoi cell of one pick among its neighbours says about the density there; all in the
/// tangent plane, the pick at (0, 0).
struct VoronoiCell {
  std::vector<double> corner_distances; ///< distances from the pick to the cell's corners: radii of
                                        ///< the largest empty circles that touch it
  double longest_step =
      0.0;               ///< to the farthest neighbour such that no other pick is closer to both
  bool complete = false; ///< false if points beyond the neighbours could still cut a corner off
                         ///< (those corners are left out)
};

/// \param[in] neighbors in any order, none at (0, 0)
/// \param[in] known all picks closer than this are among the neighbours
VoronoiCell voronoiCell(const std::vector<Eigen::Vector2d>& neighbors, double known);

} // namespace graben::detail
