#pragma once

#include "graben/mesh/bvh_node.h"

#include <cstddef>
#include <cstdint>

namespace graben::detail {

/// What a kernel sees of a TriangleBvh.
struct BvhView {
  const BvhNode* nodes;
  const std::int32_t* triangles; ///< three corners each, leaf by leaf
  const double* vertices;        ///< x y z each
  double per_length;             ///< units of the boxes in one unit of the vertices
};

/// Some points near each other that are searched for together. Lengths are in units of the boxes unless said otherwise.
struct PointGroup {
  static constexpr std::size_t kSize = 32;

  alignas(32) float at[3][kSize]; ///< the points, from the centre; those beyond the last repeat it
  std::size_t count = 0;
  double centre[3]; ///< in the vertices' frame and unit
  float low[3];     ///< box of the points in the frame of the boxes, larger by more than any rounding
  float high[3];
  float reach = 0.0F; ///< triangles farther than this from the box are not looked at

  // What searchGroup finds:
  alignas(32) float upper[kSize];        ///< the square of the distance to the nearest triangle is no larger
  alignas(32) float others[kSize];       ///< that to no triangle looked at but the one found is smaller
  alignas(32) std::int32_t place[kSize]; ///< of the triangle found, -1 for none

  /// True if the triangle found is the nearest to the point, whatever the rounding.
  bool isCertain(std::size_t point) const { return upper[point] < others[point] && upper[point] < reach * reach; }
};

/// Finds the triangle nearest to each of the points, in single precision.
/// \return false if too many triangles lie around the points, so that they had better be searched for in smaller groups; nothing is found then
bool searchGroup(const BvhView& bvh, PointGroup& group);

} // namespace graben::detail
