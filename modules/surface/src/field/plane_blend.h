#pragma once

#include "nearest_batch.h"

#include <cstdint>

namespace graben {

/// The field at a few places at once, each averaged over the planes of its nearest picks.
///
/// An array's last index is the place. Same result on every processor.
struct PlaneBlend {
  static constexpr std::size_t kPlaces = NearestBatch::kPlaces;
  static constexpr std::size_t kPicks = NearestBatch::kKept;
  static constexpr std::size_t kMostPlanes = kPicks - 2;
  using Values = double[kPlaces];

  Values place[3] = {}; ///< coordinates
  // Of each pick near a place, nearest first as far as was known:
  std::int32_t index[kPicks][kPlaces] = {};
  Values pick[kPicks][3] = {}; ///< coordinates
  Values squared[kPicks];      ///< distance to the place
  Values least_step;           ///< of the squared distances from pick to pick; more than 0 if they are in order
  // Of the first of them:
  Values centre[kMostPlanes][3] = {};
  Values normal[kMostPlanes][3] = {};
  // The result:
  Values value;
  Values from_foot; ///< distance from the first pick to where the plane of the value lies below the place; not a number where normals cancel out
};

/// Fills in the distances to the picks.
void measure(PlaneBlend& blend);

/// Fills in the result from the planes of the first picks; weights fall to zero at the pick after them.
/// \param[in] planes 2 to PlaneBlend::kMostPlanes
void blendPlanes(PlaneBlend& blend, std::size_t planes);

} // namespace graben
