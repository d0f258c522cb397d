#include "search/radix_sort.h"

#include "graben/core/threads.h"

#include <algorithm>
#include <array>

namespace graben::detail {
namespace {

constexpr unsigned DIGIT_BITS = 11;
constexpr std::size_t DIGITS = std::size_t(1) << DIGIT_BITS;
constexpr std::size_t IN_CACHE = std::size_t(1) << 17; ///< items that one thread sorts where it finds them in its cache
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

/// Puts items in the order of one digit of their keys, equals as they are; returns false if they are in it.
bool scatter(const KeyedIndex* items, std::size_t count, unsigned shift, unsigned threads, std::vector<Histogram>& counts, KeyedIndex* out) {
  const std::size_t grain = std::max<std::size_t>(1 << 16, count / 64 + 1);
  counts.resize((count + grain - 1) / grain);
  parallelBlocks(count, grain, threads, [&](std::size_t begin, std::size_t end) {
    Histogram& histogram = counts[begin / grain];
    histogram.fill(0);
    for (std::size_t i = begin; i < end; ++i)
      ++histogram[digitOf(items[i].key, shift)];
  });
  if (!countsToOffsets(counts, count))
    return false;
  parallelBlocks(count, grain, threads, [&](std::size_t begin, std::size_t end) {
    Histogram& offsets = counts[begin / grain];
    for (std::size_t i = begin; i < end; ++i)
      out[offsets[digitOf(items[i].key, shift)]++] = items[i];
  });
  return true;
}

/// Sorts by the low bits, from the least digit to the greatest, between two arrays; the result is in \a items.
void sortByDigits(KeyedIndex* items, KeyedIndex* other, std::size_t count, unsigned bits, unsigned threads, std::vector<Histogram>& counts) {
  if (count < 2)
    return;
  KeyedIndex *from = items, *to = other;
  for (unsigned shift = 0; shift < bits; shift += DIGIT_BITS)
    if (scatter(from, count, shift, threads, counts, to))
      std::swap(from, to);
  if (from != items)
    std::copy(from, from + count, items);
}

} // namespace

void radixSort(KeyedIndices& items, unsigned bits, unsigned threads) {
  std::vector<Histogram> counts;
  KeyedIndices other(items.size());
  if (bits <= DIGIT_BITS || items.size() <= IN_CACHE) {
    sortByDigits(items.data(), other.data(), items.size(), bits, threads, counts);
    return;
  }
  // By the greatest digit first, so that what is left to sort of each stays in cache.
  const unsigned low_bits = bits - DIGIT_BITS;
  std::vector<std::size_t> ends = {items.size()};
  if (scatter(items.data(), items.size(), low_bits, threads, counts, other.data())) {
    items.swap(other);
    ends.assign(counts.back().begin(), counts.back().end());
  }
  const auto sortPart = [&](std::size_t part, unsigned part_threads, std::vector<Histogram>& part_counts) {
    const std::size_t first = part == 0 ? 0 : ends[part - 1];
    sortByDigits(items.data() + first, other.data() + first, ends[part] - first, low_bits, part_threads, part_counts);
  };
  const auto isLarge = [&](std::size_t part) { return ends[part] - (part == 0 ? 0 : ends[part - 1]) > IN_CACHE; };
  parallelBlocks(ends.size(), 1, threads, [&](std::size_t part, std::size_t) {
    static thread_local std::vector<Histogram> own_counts;
    if (!isLarge(part))
      sortPart(part, 1, own_counts);
  });
  for (std::size_t part = 0; part < ends.size(); ++part)
    if (isLarge(part))
      sortPart(part, threads, counts);
}

} // namespace graben::detail
