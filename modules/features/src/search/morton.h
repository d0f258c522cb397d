#pragma once

#include <cstdint>

namespace graben::detail {

/// Spreads the low 21 bits of v so that two zero bits follow each.
inline std::uint64_t spreadBits(std::uint64_t v) {
  v &= 0x1fffffULL;
  v = (v | v << 32) & 0x1f00000000ffffULL;
  v = (v | v << 16) & 0x1f0000ff0000ffULL;
  v = (v | v << 8) & 0x100f00f00f00f00fULL;
  v = (v | v << 4) & 0x10c30c30c30c30c3ULL;
  v = (v | v << 2) & 0x1249249249249249ULL;
  return v;
}

/// Position of a lattice cell (21 bits per axis) on the Morton curve.
inline std::uint64_t mortonKey(std::uint64_t x, std::uint64_t y, std::uint64_t z) {
  return spreadBits(x) | spreadBits(y) << 1 | spreadBits(z) << 2;
}

} // namespace graben::detail
