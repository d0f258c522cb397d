#include "radix_sort.h"

#include "graben/core/threads.h"

#include <algorithm>
#include <array>

namespace graben::detail {
namespace {

constexpr unsigned DIGIT_BITS = 11;
constexpr std::size_t DIGITS = std::size_t(1) << DIGIT_BITS;
using Histogram = std::array<std::uint32_t, DIGITS>;

std::size_t digitOf(std::uint64_t key, unsigned shift) {
  return (key >> shift) & (DIGITS - 1);
}

/// Turns counts per block and digit into the position of each block's first item of that digit.
/// Returns false if all items share one digit, so that there is nothing to do.
bool countsToOffsets(std::vector<Histogram>& counts, std::size_t total) {
  std::uint32_t offset = 0;
  for (std::size_t digit = 0; digit < DIGITS; ++digit) {
    const std::uint32_t first = offset;
    for (Histogram& block : counts) {
      const std::uint32_t count = block[digit];
      block[digit] = offset;
      offset += count;
    }
    if (offset - first == total)
      return false;
  }
  return true;
}

} // namespace

void radixSort(KeyedIndices& items, unsigned bits, unsigned threads) {
  const std::size_t grain = std::max<std::size_t>(1 << 16, items.size() / 64 + 1);
  std::vector<Histogram> counts((items.size() + grain - 1) / grain);
  KeyedIndices other(items.size());
  for (unsigned shift = 0; shift < bits; shift += DIGIT_BITS) {
    parallelBlocks(items.size(), grain, threads, [&](std::size_t begin, std::size_t end) {
      Histogram& histogram = counts[begin / grain];
      histogram.fill(0);
      for (std::size_t i = begin; i < end; ++i)
        ++histogram[digitOf(items[i].key, shift)];
    });
    if (!countsToOffsets(counts, items.size()))
      continue;
    parallelBlocks(items.size(), grain, threads, [&](std::size_t begin, std::size_t end) {
      Histogram& offsets = counts[begin / grain];
      for (std::size_t i = begin; i < end; ++i)
        other[offsets[digitOf(items[i].key, shift)]++] = items[i];
    });
    items.swap(other);
  }
}

} // namespace graben::detail
