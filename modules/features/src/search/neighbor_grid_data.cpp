#include "search/neighbor_grid_data.h"

#include "graben/core/threads.h"
#include "search/radix_sort.h"

#include <algorithm>
#include <functional>
#include <numeric>

namespace graben::detail {
namespace {

constexpr std::size_t GRAIN = 1 << 15;

bool areSorted(const CellKeys& keys, unsigned threads) {
  std::vector<char> sorted((keys.size() + GRAIN - 1) / GRAIN);
  parallelBlocks(keys.size(), GRAIN, threads, [&](std::size_t begin, std::size_t end) {
    const auto first = keys.begin() + static_cast<std::ptrdiff_t>(begin);
    sorted[begin / GRAIN] = std::is_sorted(first, keys.begin() + static_cast<std::ptrdiff_t>(std::min(end + 1, keys.size()))) ? 1 : 0;
  });
  return std::find(sorted.begin(), sorted.end(), 0) == sorted.end();
}

/// The key of each point; a point that is not finite has the key of the one before it.
CellKeys fineKeys(const Points& points, const CellLattice& lattice, unsigned threads) {
  constexpr std::uint64_t NONE = ~std::uint64_t(0); // a key has 63 bits
  CellKeys keys(points.size());
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

/// Where the finite points of each block of GRAIN stand among all finite ones, and after the last block their number.
std::vector<std::size_t> firstFinite(const Vector3* points, std::size_t count, unsigned threads) {
  std::vector<std::size_t> first((count + GRAIN - 1) / GRAIN + 1, 0);
  parallelBlocks(count, GRAIN, threads, [&](std::size_t begin, std::size_t end) {
    first[begin / GRAIN + 1] =
        static_cast<std::size_t>(std::count_if(points + begin, points + end, [](const Vector3& p) { return p.allFinite(); }));
  });
  std::partial_sum(first.begin(), first.end(), first.begin());
  return first;
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

std::vector<Index> finitePoints(const Vector3* points, std::size_t count, unsigned threads) {
  const std::vector<std::size_t> first = firstFinite(points, count, threads);
  std::vector<Index> finite(first.back());
  parallelBlocks(count, GRAIN, threads, [&](std::size_t begin, std::size_t end) {
    std::size_t at = first[begin / GRAIN];
    const bool all = first[begin / GRAIN + 1] - at == end - begin;
    for (std::size_t i = begin; i < end; ++i)
      if (all || points[i].allFinite())
        finite[at++] = static_cast<Index>(i);
  });
  return finite;
}

std::vector<Index> sortByKey(const Points& points, SortedKeys& sorted, unsigned threads) {
  const std::vector<std::size_t> first = firstFinite(points.data(), points.size(), threads);
  KeyedIndices items(first.back());
  std::vector<std::uint64_t> any(first.size(), 0);
  parallelBlocks(points.size(), GRAIN, threads, [&](std::size_t begin, std::size_t end) {
    std::size_t at = first[begin / GRAIN];
    std::uint64_t all = 0;
    for (std::size_t i = begin; i < end; ++i)
      if (points[i].allFinite()) {
        const std::uint64_t key = sorted.lattice.fineKey(points[i]);
        items[at++] = {key, static_cast<Index>(i)};
        all |= key;
      }
    any[begin / GRAIN] = all;
  });
  const std::uint64_t all = std::accumulate(any.begin(), any.end(), std::uint64_t(0), std::bit_or<std::uint64_t>());
  unsigned bits = 1;
  while (bits < 64 && (all >> bits) != 0)
    ++bits;
  radixSort(items, bits, threads);
  std::vector<Index> order(items.size());
  sorted.keys.resize(items.size());
  parallelFor(items.size(), GRAIN, threads, [&](std::size_t i) {
    sorted.keys[i] = items[i].key;
    order[i] = items[i].index;
  });
  return order;
}

std::vector<Index> NeighborGridData::build(const Points& points, unsigned threads) {
  std::vector<Index> order;
  SortedKeys sorted{lattice, fineKeys(points, lattice, threads)};
  if (areSorted(sorted.keys, threads)) {
    order = finitePoints(points.data(), points.size(), threads);
    if (!order.empty())
      index(points.data(), sorted.keys, threads);
    return order;
  }
  order = sortByKey(points, sorted, threads);
  ordered.indices = order.data();
  ordered.copy.resize(order.size());
  parallelFor(order.size(), GRAIN, threads, [&](std::size_t i) { ordered.copy[i] = points[static_cast<std::size_t>(order[i])]; });
  index(ordered.copy.data(), sorted.keys, threads);
  return order;
}

std::vector<Index> NeighborGridData::buildInOrder(const Points& points, const CellKeys& keys, unsigned threads) {
  std::vector<Index> order(keys.size());
  std::iota(order.begin(), order.end(), 0);
  if (!order.empty())
    index(points.data(), keys, threads);
  return order;
}

/// Sets all but the lattice for points in order. \param[in] keys of the points, which tell their number
void NeighborGridData::index(const Vector3* points, const CellKeys& keys, unsigned threads) {
  ordered.points = points;
  ordered.count = keys.size();
  buildBlocks(keys, threads);
  buildTable();
  tree.build(ordered, threads);
}

void NeighborGridData::buildBlocks(const CellKeys& keys, unsigned threads) {
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
