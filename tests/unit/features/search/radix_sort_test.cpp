#include "search/radix_sort.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace graben::detail {
namespace {

/// \param[in] key of the item with a number
template <typename Key>
void expectSortedAsByComparison(std::size_t count, unsigned bits, const Key& key) {
  KeyedIndices items(count);
  for (std::size_t i = 0; i < count; ++i)
    items[i] = {key(i), static_cast<Index>(i)};
  KeyedIndices expected = items;
  std::stable_sort(expected.begin(), expected.end(), [](const KeyedIndex& a, const KeyedIndex& b) { return a.key < b.key; });
  for (const unsigned threads : {1U, 3U}) {
    KeyedIndices sorted = items;
    radixSort(sorted, bits, threads);
    for (std::size_t i = 0; i < count; ++i)
      ASSERT_TRUE(sorted[i].key == expected[i].key && sorted[i].index == expected[i].index) << "item " << i << " of " << count;
  }
}

TEST(RadixSort, AsByComparison) {
  std::mt19937_64 random(3);
  for (const std::size_t count : {0U, 1U, 1000U, 200000U})
    for (const unsigned bits : {1U, 11U, 12U, 23U, 45U, 63U})
      expectSortedAsByComparison(count, bits, [&](std::size_t) { return random() >> (64 - bits); });
}

TEST(RadixSort, NearlyAllKeysShareTheirFirstBits) {
  std::mt19937_64 random(4);
  expectSortedAsByComparison(200000, 45, [&](std::size_t i) { return (random() >> 45) | (i % 1000 == 7 ? std::uint64_t(1) << 44 : 0); });
  expectSortedAsByComparison(200000, 45, [](std::size_t i) { return std::uint64_t(1) << (i % 45); });
  expectSortedAsByComparison(200000, 45, [](std::size_t) { return std::uint64_t(77) << 30; });
}

} // namespace
} // namespace graben::detail
