#pragma once

#include "graben/core/export.h"

#include <cstddef>
#include <cstdint>
#include <limits>

GRABEN_EXPORT_BEGIN
namespace graben::detail {

/// Node of a TriangleBvh: the boxes of up to four children in units of the hierarchy, rounded to the nearest float. Plain numbers, for
/// kernels that keep clear of Eigen.
struct alignas(16) BvhNode {
  static constexpr float kNowhere = 1e18F; ///< coordinates of a box that is not there
  static constexpr std::int32_t kNoChild = std::numeric_limits<std::int32_t>::min();

  float low[3][4] = {{kNowhere, kNowhere, kNowhere, kNowhere}, {kNowhere, kNowhere, kNowhere, kNowhere}, {kNowhere, kNowhere, kNowhere, kNowhere}};
  float high[3][4] = {{kNowhere, kNowhere, kNowhere, kNowhere}, {kNowhere, kNowhere, kNowhere, kNowhere}, {kNowhere, kNowhere, kNowhere, kNowhere}};
  std::int32_t child[4] = {kNoChild, kNoChild, kNoChild, kNoChild}; ///< node; leaf: ~(2 * first place + count - 1)

  static std::size_t firstPlace(std::int32_t leaf) { return static_cast<std::size_t>(~leaf / 2); }
  static std::size_t lastPlace(std::int32_t leaf) { return firstPlace(leaf) + static_cast<std::size_t>(~leaf % 2); }
};

} // namespace graben::detail
GRABEN_EXPORT_END
