#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace graben {

/// A few places and the points nearest to each of them, found together in single precision: what is nearest in truth is to be told from these few.
struct NearestBatch {
  static constexpr std::size_t kPlaces = 8;
  static constexpr std::size_t kKept = 6;          ///< points found for each place
  static constexpr std::uint32_t kPoints = 1 << 10; ///< most points to look through: their numbers take the place of the last bits of distances

  float x[kPlaces] = {};
  float y[kPlaces] = {};
  float z[kPlaces] = {};
  float found[kKept][kPlaces]; ///< of each place the nearest points, nearest first: squared distance and number in one; kNone where there are fewer

  static constexpr float kNone = 1e30F;

  static std::uint32_t bitsOf(float key) {
    std::uint32_t bits = 0;
    std::memcpy(&bits, &key, sizeof bits);
    return bits;
  }
  /// Number of the point a key stands for.
  static std::uint32_t number(float key) { return bitsOf(key) & (kPoints - 1); }
  /// What no point's squared distance was less than, in single precision, that has this key or a greater one.
  static float least(float key) {
    const std::uint32_t bits = bitsOf(key) & ~(kPoints - 1);
    std::memcpy(&key, &bits, sizeof key);
    return key;
  }
};

/// Fills in NearestBatch::found.
///
/// Coordinates are to lie between -1 and 1, at most NearestBatch::kPoints of them; then a squared distance errs by less than 2^-18 before the number
/// takes its last bits. The same result on every processor.
void findNearest(const float* x, const float* y, const float* z, std::size_t count, NearestBatch& batch);

} // namespace graben
