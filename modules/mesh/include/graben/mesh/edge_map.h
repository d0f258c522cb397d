#pragma once

#include "graben/core/export.h"
#include "graben/core/types.h"

#include <cstdint>
#include <utility>
#include <vector>

GRABEN_EXPORT_BEGIN
namespace graben {

/// What belongs to pairs of indices, such as edges, whichever of the two comes first: an index for each pair. Open addressing; O(1) in practice.
class EdgeMap {
public:
  static constexpr Index kNone = -1;

  /// One number for a pair, the same for both orders.
  static std::uint64_t key(Index a, Index b) {
    if (a > b)
      std::swap(a, b);
    return (static_cast<std::uint64_t>(static_cast<std::uint32_t>(a)) << 32) | static_cast<std::uint32_t>(b);
  }

  std::size_t size() const { return size_; }

  /// \return what is kept for the pair; kNone if there is nothing
  Index find(Index a, Index b) const {
    if (slots_.empty())
      return kNone;
    const std::uint64_t wanted = key(a, b);
    for (std::size_t i = start(wanted);; i = (i + 1) & (slots_.size() - 1)) {
      if (slots_[i].value == kNone)
        return kNone;
      if (slots_[i].key == wanted)
        return slots_[i].value;
    }
  }

  /// Keeps \a value for a pair that has none. \return what the pair has now: \a value, or what was there before
  Index insert(Index a, Index b, Index value) {
    if (2 * (size_ + 1) > slots_.size())
      grow();
    const std::uint64_t wanted = key(a, b);
    std::size_t i = start(wanted);
    for (; slots_[i].value != kNone; i = (i + 1) & (slots_.size() - 1))
      if (slots_[i].key == wanted)
        return slots_[i].value;
    slots_[i] = {wanted, value};
    ++size_;
    return value;
  }

private:
  struct Slot {
    std::uint64_t key = 0;
    Index value = kNone;
  };

  std::size_t start(std::uint64_t k) const {
    k ^= k >> 29;
    k *= 0xbf58476d1ce4e5b9ULL;
    k ^= k >> 32;
    return static_cast<std::size_t>(k) & (slots_.size() - 1);
  }

  void grow() {
    std::vector<Slot> before(slots_.empty() ? 64 : 2 * slots_.size());
    before.swap(slots_);
    for (const Slot& slot : before) {
      if (slot.value == kNone)
        continue;
      std::size_t i = start(slot.key);
      while (slots_[i].value != kNone)
        i = (i + 1) & (slots_.size() - 1);
      slots_[i] = slot;
    }
  }

  std::vector<Slot> slots_;
  std::size_t size_ = 0;
};

} // namespace graben
GRABEN_EXPORT_END
