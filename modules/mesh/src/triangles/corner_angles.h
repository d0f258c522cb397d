#pragma once

#include <cstddef>

namespace graben::detail {

/// Corners of triangles, one array for each quantity.
struct CornerArrays {
  const double* sine;   ///< of the angle, times a length
  const double* cosine; ///< times the same length
  std::size_t count;    ///< all arrays have room for a multiple of kCornerLanes
};

constexpr std::size_t kCornerLanes = 4;

/// The angles, 0 to pi, over their sine; 0 where the sine is not positive and finite. To within a few units in the last place, and the same on every
/// processor.
void anglesPerSine(const CornerArrays& corners, double* result);

} // namespace graben::detail
