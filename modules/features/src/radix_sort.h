#pragma once

#include "graben/core/types.h"

#include <cstdint>
#include <vector>

namespace graben::detail {

struct KeyedIndex {
  std::uint64_t key;
  Index index;
};

/// Stable sort by the low \a bits bits of the key; O(n bits / 11), the same result for any number
/// of threads.
void radixSort(std::vector<KeyedIndex>& items, unsigned bits, unsigned threads);

} // namespace graben::detail
