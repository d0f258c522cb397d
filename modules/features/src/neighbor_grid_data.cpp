#include "neighbor_grid_data.h"

#include "graben/core/threads.h"
#include "radix_sort.h"

#include <algorithm>

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
  parallelFor(points.size(), GRAIN, threads,
              [&](std::size_t i) { keys[i] = points[i].allFinite() ? lattice.fineKey(points[i]) : NONE; });
  std::uint64_t last = 0;
  for (std::uint64_t& key : keys)
    last = key = key == NONE ? last : key;
  return keys;
}

std::vector<Index> sortByKey(const Points& points, std::vector<std::uint64_t>& keys, unsigned threads) {
  std::vector<KeyedIndex> items;
  items.reserve(points.size());
  std::uint64_t any = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points[i].allFinite()) {
      items.push_back({keys[i], static_cast<Index>(i)});
      any |= keys[i];
    }
  unsigned bits = 1;
  while (bits < 64 && (any >> bits) != 0)
    ++bits;
  radixSort(items, bits, threads);
  keys.resize(items.size());
  std::vector<Index> order(items.size());
  parallelFor(items.size(), GRAIN, threads, [&](std::size_t i) {
    keys[i] = items[i].key;
    order[i] = items[i].index;
  });
  return order;
}

void NeighborGridData::build(const Points& points, unsigned threads) {
  std::vector<std::uint64_t> keys = fineKeys(points, lattice, threads);
  if (areSorted(keys, threads)) {
    ordered.points = points.data();
    ordered.count = points.size();
    findOrder();
  } else {
    order = sortByKey(points, keys, threads);
    ordered.indices = order.data();
    ordered.copy.resize(order.size());
    parallelFor(order.size(), GRAIN, threads, [&](std::size_t i) { ordered.copy[i] = points[static_cast<std::size_t>(order[i])]; });
    ordered.points = ordered.copy.data();
    ordered.count = ordered.copy.size();
  }
  if (order.empty())
    return;
  buildBlocks(keys, threads);
  buildTable();
  tree.build(ordered, threads);
}

void NeighborGridData::findOrder() {
  order.resize(ordered.count);
  std::size_t finite = 0;
  for (std::size_t i = 0; i < ordered.count; ++i) {
    order[finite] = static_cast<Index>(i);
    finite += ordered.points[i].allFinite() ? 1 : 0;
  }
  order.resize(finite);
}

void NeighborGridData::buildBlocks(const std::vector<std::uint64_t>& keys, unsigned threads) {
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const std::uint64_t key = lattice.blockKey(keys[i]);
    if (blocks.empty() || blocks.back().key != key) {
      blocks.emplace_back();
      blocks.back().key = key;
      blocks.back().first = static_cast<std::uint32_t>(i);
    }
    ++blocks.back().count;
  }
  parallelFor(blocks.size(), 256, threads, [&](std::size_t b) {
    if (!blocks[b].crowded())
      fillOffsets(blocks[b], keys.data(), lattice);
  });
}

void NeighborGridData::buildTable() {
  unsigned bits = 2;
  while ((std::size_t(1) << bits) < 2 * blocks.size())
    ++bits;
  table_shift = 64 - bits;
  table.assign(std::size_t(1) << bits, -1);
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    std::size_t slot = slotOf(blocks[b].key);
    while (table[slot] >= 0)
      slot = (slot + 1) & (table.size() - 1);
    table[slot] = static_cast<std::int32_t>(b);
  }
}

} // namespace graben::detail
