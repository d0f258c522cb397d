#include "picks/repeated_picks.h"

#include <cstdint>
#include <cstring>
#include <limits>

namespace graben {

namespace {

std::uint64_t hashOf(const Vector3& p) {
  std::uint64_t hash = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double value = p[axis] + 0.0; // -0 is 0
    std::uint64_t bits = 0;
    std::memcpy(&bits, &value, sizeof(bits));
    hash = (hash ^ bits) * 0x9e3779b97f4a7c15U;
    hash ^= hash >> 29;
  }
  return hash;
}

} // namespace

std::size_t dropRepeated(Points& points) {
  std::size_t slots = 16;
  while (slots < 2 * points.size())
    slots *= 2;
  constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> first(slots, kNone);
  std::size_t dropped = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    Vector3& p = points[i];
    if (!p.allFinite())
      continue;
    std::size_t slot = hashOf(p) & (slots - 1);
    while (first[slot] != kNone && points[first[slot]] != p)
      slot = (slot + 1) & (slots - 1);
    if (first[slot] == kNone) {
      first[slot] = static_cast<std::uint32_t>(i);
    } else {
      p.setConstant(std::numeric_limits<double>::quiet_NaN());
      ++dropped;
    }
  }
  return dropped;
}

} // namespace graben
