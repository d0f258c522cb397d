#include "neighbor_grid_data.h"

#include "graben/core/threads.h"
#include "radix_sort.h"

#include <algorithm>
#include <functional>
#include <numeric>

namespace graben::detail {
namespace {

constexpr std::size_t GRAIN = 1 << 15;

bool areSorted(const std::vector<std::uint64_t>& keys, unsigned threads) {
  std::vector<char> sorted((keys.size() + GRAIN - 1) / GRAIN);
  parallelBlocks(keys.size(), GRAIN, threads, [&](std::size_t begin, std::size_t end) {
    const auto first = keys.begin() + static_cast<std::ptrdiff_t>(begin);
    sorted[begin / GRAIN] = std::is_sorted(first, keys.begin() + static_cast<std::ptrdiff_t>(std::min(end + 1, keys.size()))) ? 1 : 0;
  });
  return std::find(sorted.begin(), sorted.end(), 0) == sorted.end();
}

void fillOffsets(Block& block, const std::uint64_t* keys, const CellLattice& lattice) {
  for (std::uint32_t i = 0; i < block.count; ++i) {
    const unsigned cell = lattice.cellInBlock(keys[block.first + i]);
    block.occupied |= std::uint64_t(1) << cell;
    ++block.offset[cell + 1];
  }
  for (std::size_t cell = 0; cell < 64; ++cell)
    block.offset[cell + 1] =
        static_cast<std::uint16_t>(block.offset[cell + 1] + block.offset[cell]);
}

} // namespace

std::vector<std::uint64_t> fineKeys(const Points& points, const CellLattice& lattice, unsigned threads) {
  constexpr std::uint64_t NONE = ~std::uint64_t(0); // a key has 63 bits
  std::vector<std::uint64_t> keys(points.size());
  parallelBlocks(points.size(), GRAIN, threads, [&](std::size_t begin, std::size_t end) {
    std::uint64_t last = NONE;
    for (std::size_t i = begin; i < end; ++i)
      last = keys[i] = points[i].allFinite() ? lattice.fineKey(points[i]) : last;
  });
  for (std::size_t begin = 0; begin < keys.size(); begin += GRAIN)
    for (std::size_t i = begin; i < keys.size() && keys[i] == NONE; ++i)
      keys[i] = i == 0 ? 0 : keys[i - 1];
  return keys;
}

std::vector<Index> finitePoints(const Vector3* points, std::size_t count, unsigned threads) {
  std::vector<std::size_t> first((count + GRAIN - 1) / GRAIN + 1, 0);
  parallelBlocks(count, GRAIN, threads, [&](std::size_t begin, std::size_t end) {
    first[begin / GRAIN + 1] =
        static_cast<std::size_t>(std::count_if(points + begin, points + end, [](const Vector3& p) { return p.allFinite(); }));
  });
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<Index> finite(first.back());
  parallelBlocks(count, GRAIN, threads, [&](std::size_t begin, std::size_t end) {
    std::size_t at = first[begin / GRAIN];
    for (std::size_t i = begin; i < end; ++i)
      if (points[i].allFinite())
        finite[at++] = static_cast<Index>(i);
  });
  return finite;
}

std::vector<Index> sortByKey(const Points& points, std::vector<std::uint64_t>& keys, unsigned threads) {
  std::vector<Index> order = finitePoints(points.data(), points.size(), threads);
  KeyedIndices items(order.size());
  std::vector<std::uint64_t> any((order.size() + GRAIN - 1) / GRAIN, 0);
  parallelBlocks(order.size(), GRAIN, threads, [&](std::size_t begin, std::size_t end) {
    std::uint64_t all = 0;
    for (std::size_t i = begin; i < end; ++i) {
      items[i] = {keys[static_cast<std::size_t>(order[i])], order[i]};
      all |= items[i].key;
    }
    any[begin / GRAIN] = all;
  });
  const std::uint64_t all = std::accumulate(any.begin(), any.end(), std::uint64_t(0), std::bit_or<std::uint64_t>());
  unsigned bits = 1;
  while (bits < 64 && (all >> bits) != 0)
    ++bits;
  radixSort(items, bits, threads);
  keys.resize(items.size());
  parallelFor(items.size(), GRAIN, threads, [&](std::size_t i) {
    keys[i] = items[i].key;
    order[i] = items[i].index;
  });
  return order;
}

std::vector<Index> NeighborGridData::build(const Points& points, unsigned threads) {
  std::vector<Index> order;
  std::vector<std::uint64_t> keys = fineKeys(points, lattice, threads);
  if (areSorted(keys, threads)) {
    ordered.points = points.data();
    ordered.count = points.size();
    order = finitePoints(ordered.points, ordered.count, threads);
  } else {
    order = sortByKey(points, keys, threads);
    ordered.indices = order.data();
    ordered.copy.resize(order.size());
    parallelFor(order.size(), GRAIN, threads, [&](std::size_t i) { ordered.copy[i] = points[static_cast<std::size_t>(order[i])]; });
    ordered.points = ordered.copy.data();
    ordered.count = ordered.copy.size();
  }
  if (order.empty())
    return order;
  buildBlocks(keys, threads);
  buildTable();
  tree.build(ordered, threads);
  return order;
}

void NeighborGridData::buildBlocks(const std::vector<std::uint64_t>& keys, unsigned threads) {
  std::vector<std::vector<std::uint32_t>> firsts((keys.size() + GRAIN - 1) / GRAIN);
  parallelBlocks(keys.size(), GRAIN, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      if (i == 0 || lattice.blockKey(keys[i]) != lattice.blockKey(keys[i - 1]))
        firsts[begin / GRAIN].push_back(static_cast<std::uint32_t>(i));
  });
  std::size_t count = 0;
  for (const std::vector<std::uint32_t>& part : firsts)
    count += part.size();
  blocks.resize(count);
  std::size_t end = keys.size();
  for (auto part = firsts.rbegin(); part != firsts.rend(); ++part)
    for (auto first = part->rbegin(); first != part->rend(); ++first) {
      Block& block = blocks[--count];
      block.key = lattice.blockKey(keys[*first]);
      block.first = *first;
      block.count = static_cast<std::uint32_t>(end - *first);
      end = *first;
    }
  parallelFor(blocks.size(), 256, threads, [&](std::size_t b) {
    if (blocks[b].crowded())
      return;
    fillOffsets(blocks[b], keys.data(), lattice);
    blocks[b].may_repeat = mayRepeat(blocks[b], keys.data());
  });
}

/// Points at one place have the same key, so that only those between them in the order need to be looked at.
bool NeighborGridData::mayRepeat(const Block& block, const std::uint64_t* keys) const {
  constexpr std::uint32_t MOST = 16; // of the same key; more count as repeating
  const std::uint32_t end = block.first + block.count;
  for (std::uint32_t i = block.first; i < end; ++i)
    for (std::uint32_t other = i + 1; other < end && keys[other] == keys[i]; ++other)
      if (other - i > MOST || ordered.points[other] == ordered.points[i])
        return true;
  return false;
}

void NeighborGridData::buildTable() {
  std::size_t count = 0;
  for (std::size_t b = 0; b < blocks.size(); ++b)
    count += b == 0 || blocks[b].key >> 6 != blocks[b - 1].key >> 6 ? 1 : 0;
  unsigned bits = 2;
  while ((std::size_t(1) << bits) < 2 * count)
    ++bits;
  table_shift = 64 - bits;
  superblocks.assign(std::size_t(1) << bits, {});
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const std::uint64_t key = blocks[b].key >> 6;
    std::size_t slot = slotOf(key);
    while (superblocks[slot].occupied != 0 && superblocks[slot].key != key)
      slot = (slot + 1) & (superblocks.size() - 1);
    Superblock& superblock = superblocks[slot];
    if (superblock.occupied == 0) {
      superblock.key = key;
      superblock.first = static_cast<std::uint32_t>(b);
    }
    superblock.occupied |= std::uint64_t(1) << (blocks[b].key & 63U);
  }
}

} // namespace graben::detail
