#pragma once

#include "search/cell_lattice.h"
#include "graben/features/neighbor_grid.h"
#include "search/point_tree.h"
#include "search/radix_sort.h"

#include <array>

namespace graben::detail {

/// The points of 4 x 4 x 4 cells; points of a cell, and the cells by their key, follow each other.
struct Block {
  std::uint64_t key = 0;
  std::uint64_t occupied = 0; ///< bit c: cell c holds points
  std::uint32_t first = 0;    ///< position of the first point in ordered
  std::uint32_t count = 0;
  std::array<std::uint16_t, 65>
      offset{}; ///< of each cell's first point from the block's first; not set in a crowded block
  bool may_repeat = true; ///< false: all its points are at different places

  static constexpr std::uint32_t CROWDED = 4096;
  bool crowded() const { return count > CROWDED; }
};

/// 4 x 4 x 4 blocks.
struct Superblock {
  std::uint64_t key = ~std::uint64_t(0);
  std::uint64_t occupied = 0; ///< bit b: block b holds points
  std::uint32_t first = 0;    ///< position of the first of these blocks, which follow each other
};

using CellKeys = std::vector<std::uint64_t, UnsetAllocator<std::uint64_t>>;

/// The keys of points in order in a lattice.
struct SortedKeys {
  CellLattice lattice;
  CellKeys keys;
};

struct NeighborGridData {
  CellLattice lattice;
  OrderedPoints ordered; ///< with points that are not finite among them where the caller's are in order
  std::vector<Block> blocks;           ///< by their keys
  std::vector<Superblock> superblocks; ///< open-addressing hash by key; occupied is 0 where free
  unsigned table_shift = 63;
  PointTree tree;

  /// The lattice is set before. \return indices of the finite points in the order of their cells; they must live on where the points are not in
  /// order themselves, as ordered refers to them
  std::vector<Index> build(const Points& points, unsigned threads);

  /// The same of points in order, those that are not finite last, from the keys of the others.
  std::vector<Index> buildInOrder(const Points& points, const CellKeys& keys, unsigned threads);

  /// One that holds no block where there is none of that key.
  const Superblock& findSuperblock(std::uint64_t key) const {
    std::size_t slot = slotOf(key);
    while (superblocks[slot].occupied != 0 && superblocks[slot].key != key)
      slot = (slot + 1) & (superblocks.size() - 1);
    return superblocks[slot];
  }
  /// \param[in] bit one that is set in the superblock
  const Block& blockOf(const Superblock& superblock, unsigned bit) const {
    const std::uint64_t before = superblock.occupied & ((std::uint64_t(1) << bit) - 1);
    return blocks[superblock.first + static_cast<std::size_t>(__builtin_popcountll(before))];
  }
  /// Null where there is none.
  const Block* findBlock(std::uint64_t key) const {
    if (blocks.empty())
      return nullptr;
    const Superblock& superblock = findSuperblock(key >> 6);
    const auto bit = static_cast<unsigned>(key & 63U);
    return (superblock.occupied >> bit & 1U) != 0 ? &blockOf(superblock, bit) : nullptr;
  }

private:
  void index(const Vector3* points, const CellKeys& keys, unsigned threads);
  std::size_t slotOf(std::uint64_t key) const {
    return static_cast<std::size_t>((key * 0x9e3779b97f4a7c15ULL) >> table_shift);
  }
  void buildBlocks(const CellKeys& keys, unsigned threads);
  bool mayRepeat(const Block& block, const std::uint64_t* keys) const;
  void buildTable();
};

/// The indices of the points that are finite, ascending.
std::vector<Index> finitePoints(const Vector3* points, std::size_t count, unsigned threads);

/// Sorts the finite points by their keys in the lattice, equals by index; returns their indices and sets the keys.
std::vector<Index> sortByKey(const Points& points, SortedKeys& sorted, unsigned threads);

} // namespace graben::detail
