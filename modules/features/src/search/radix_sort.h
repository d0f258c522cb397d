#pragma once

#include "graben/core/types.h"

#include <cstdint>
#include <memory>
#include <new>
#include <utility>
#include <vector>

namespace graben::detail {

struct KeyedIndex {
  std::uint64_t key;
  Index index;
};

/// Leaves new elements unset, so that the threads which fill a large array touch its pages first.
template <typename T>
struct UnsetAllocator : std::allocator<T> {
  template <typename U>
  struct rebind {
    using other = UnsetAllocator<U>;
  };
  template <typename U, typename... Arguments>
  void construct(U* place, Arguments&&... arguments) {
    if constexpr (sizeof...(Arguments) > 0)
      ::new (static_cast<void*>(place)) U{std::forward<Arguments>(arguments)...};
  }
};

using KeyedIndices = std::vector<KeyedIndex, UnsetAllocator<KeyedIndex>>;

/// Stable sort by the low \a bits bits of the key; O(n bits / 11), the same result for any number
/// of threads.
void radixSort(KeyedIndices& items, unsigned bits, unsigned threads);

} // namespace graben::detail
