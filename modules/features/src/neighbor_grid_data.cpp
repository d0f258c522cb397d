#include "neighbor_grid_data.h"

#include "graben/core/threads.h"
#include "radix_sort.h"

namespace graben::detail {
namespace {

constexpr std::size_t GRAIN = 1 << 15;

std::vector<Index> finiteIndices(const Points& points) {
  std::vector<Index> indices;
  indices.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points[i].allFinite())
      indices.push_back(static_cast<Index>(i));
  return indices;
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

void NeighborGridData::build(const Points& points, double cell_size, unsigned threads) {
  const std::vector<Index> indices = finiteIndices(points);
  if (indices.empty())
    return;
  lattice = chooseLattice(points, indices, cell_size, threads);
  std::vector<KeyedIndex> items(indices.size());
  parallelFor(items.size(), GRAIN, threads, [&](std::size_t i) {
    items[i] = {lattice.fineKey(points[static_cast<std::size_t>(indices[i])]), indices[i]};
  });
  std::uint64_t any = 0;
  for (const KeyedIndex& item : items)
    any |= item.key;
  unsigned bits = 1;
  while (bits < 64 && (any >> bits) != 0)
    ++bits;
  radixSort(items, bits, threads);

  std::vector<std::uint64_t> keys(items.size());
  for (std::vector<double>* axis : {&ordered.x, &ordered.y, &ordered.z})
    axis->resize(items.size());
  ordered.index.resize(items.size());
  parallelFor(items.size(), GRAIN, threads, [&](std::size_t i) {
    const Vector3& p = points[static_cast<std::size_t>(items[i].index)];
    keys[i] = items[i].key;
    ordered.index[i] = items[i].index;
    ordered.x[i] = p.x();
    ordered.y[i] = p.y();
    ordered.z[i] = p.z();
  });
  buildBlocks(keys, threads);
  buildTable();
  tree.build(ordered, threads);
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
