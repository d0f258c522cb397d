#pragma once

#include <cstddef>

namespace graben {

/// A few places and how far each is from the nearest of the points it has been shown.
struct DistanceBatch {
  static constexpr std::size_t kPlaces = 4;

  double x[kPlaces] = {};
  double y[kPlaces] = {};
  double z[kPlaces] = {};
  double squared[kPlaces] = {}; ///< distance; to begin with that beyond which points do not count

  /// Lowers the distances. Points that are not finite are passed over. The same bits as of one point and place at a time.
  /// \param[in] points x y z x y z ...
  void show(const double* points, std::size_t count);
};

} // namespace graben
