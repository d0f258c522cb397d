#pragma once

#include "graben/surface/lattice.h"
#include "graben/surface/signed_distance.h"

#include <memory>
#include <vector>

namespace graben {

/// A set of cells or lattice vertices of one block of 4 x 4 x 4: bit 16 i + 4 j + k.
using BlockMask = std::uint64_t;

namespace block {

constexpr int kSlots = 64;
/// The blocks whose vertices a block's cells have as corners: (0,0,0), (0,0,1), (0,1,0), ... (1,1,1), as 4 i + 2 j + k.
constexpr std::size_t kForward = 8;
constexpr std::array<int, 3> kShift = {16, 4, 1};
constexpr std::array<BlockMask, 3> kFirst = {0x000000000000ffffULL, 0x000f000f000f000fULL, 0x1111111111111111ULL};
constexpr std::array<BlockMask, 3> kLast = {kFirst[0] << 48, kFirst[1] << 12, kFirst[2] << 3};

inline int slotOf(const LatticeIndex& p) { return ((p.i & 3) << 4) | ((p.j & 3) << 2) | (p.k & 3); }
inline LatticeIndex inBlock(int slot) { return {slot >> 4, (slot >> 2) & 3, slot & 3}; }
inline LatticeIndex blockOf(const LatticeIndex& p) { return {p.i >> 2, p.j >> 2, p.k >> 2}; }
constexpr LatticeIndex forward(std::size_t f) { return {static_cast<int>(f >> 2), static_cast<int>((f >> 1) & 1), static_cast<int>(f & 1)}; }
inline LatticeIndex vertexOf(const LatticeIndex& at, int slot) { return {4 * at.i + (slot >> 4), 4 * at.j + ((slot >> 2) & 3), 4 * at.k + (slot & 3)}; }
inline BlockMask bit(int slot) { return BlockMask(1) << slot; }
inline int lowest(BlockMask mask) { return __builtin_ctzll(mask); }

/// Number of members; compilers call a slow function for the builtin unless told the processor.
inline Index count(BlockMask m) {
  m -= (m >> 1) & 0x5555555555555555ULL;
  m = (m & 0x3333333333333333ULL) + ((m >> 2) & 0x3333333333333333ULL);
  m = (m + (m >> 4)) & 0x0f0f0f0f0f0f0f0fULL;
  return static_cast<Index>((m * 0x0101010101010101ULL) >> 56);
}
/// Members before a slot.
inline Index rank(BlockMask mask, int slot) { return count(mask & (bit(slot) - 1)); }

/// What lies one step further along an axis: member s of the result is member s + 1 of the block, or of the next block.
inline BlockMask pull(BlockMask own, BlockMask next, std::size_t axis) {
  return ((own & ~kFirst[axis]) >> kShift[axis]) | ((next & kFirst[axis]) << (3 * kShift[axis]));
}

/// The inverse of pull(): what lies one step back along an axis.
inline BlockMask push(BlockMask own, BlockMask before, std::size_t axis) {
  return ((own & ~kLast[axis]) << kShift[axis]) | ((before & kLast[axis]) >> (3 * kShift[axis]));
}

/// Moves the members of neighbouring blocks by an offset of 0 or 1 along each axis, where \a step moves by one.
template <typename Step>
[[gnu::always_inline]] inline BlockMask moved(const std::array<BlockMask, kForward>& m, const LatticeIndex& at, const Step& step) {
  std::array<BlockMask, 4> i{};
  for (std::size_t f = 0; f < 4; ++f)
    i[f] = at.i != 0 ? step(m[f], m[f + 4], 0) : m[f];
  const BlockMask low = at.j != 0 ? step(i[0], i[2], 1) : i[0];
  const BlockMask high = at.j != 0 ? step(i[1], i[3], 1) : i[1];
  return at.k != 0 ? step(low, high, 2) : low;
}

/// For each cell whether its corner at an offset of 0 or 1 along each axis is a member, from the vertices of the forward blocks.
inline BlockMask corner(const std::array<BlockMask, kForward>& m, const LatticeIndex& at) {
  return moved(m, at, [](BlockMask own, BlockMask next, std::size_t axis) { return pull(own, next, axis); });
}

/// For each vertex whether the cell of which it is the given corner is a member, from the cells of the blocks behind (numbered as the forward ones).
inline BlockMask cellWithCorner(const std::array<BlockMask, kForward>& m, const LatticeIndex& at) {
  return moved(m, at, [](BlockMask own, BlockMask before, std::size_t axis) { return push(own, before, axis); });
}

/// All corners of cells, as vertices of the forward blocks.
inline std::array<BlockMask, kForward> cornersOf(BlockMask cells) {
  std::array<BlockMask, kForward> m{};
  m[0] = cells;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t step = std::size_t(4) >> axis;
    for (std::size_t f = 0; f < kForward; ++f) {
      if ((f & step) != 0)
        continue;
      m[f | step] |= (m[f] & kLast[axis]) >> (3 * kShift[axis]);
      m[f] |= (m[f] & ~kLast[axis]) << kShift[axis];
    }
  }
  return m;
}

/// The members whose index along an axis is \a first to \a last, of 0 to 3.
inline BlockMask layers(std::size_t axis, int first, int last) {
  BlockMask mask = 0;
  for (int layer = first; layer <= last; ++layer)
    mask |= kFirst[axis] << (layer * kShift[axis]);
  return mask;
}

/// All cells around edges along an axis, which are given by their low ends: as cells of the blocks behind (numbered as the forward ones).
inline std::array<BlockMask, kForward> cellsAround(BlockMask edges, std::size_t along) {
  std::array<BlockMask, kForward> m{};
  m[0] = edges;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t step = std::size_t(4) >> axis;
    for (std::size_t f = 0; f < kForward && axis != along; ++f) {
      if ((f & step) != 0)
        continue;
      m[f | step] |= (m[f] & kFirst[axis]) << (3 * kShift[axis]);
      m[f] |= (m[f] & ~kFirst[axis]) >> kShift[axis];
    }
  }
  return m;
}

} // namespace block

/// Numbers of blocks by their keys (see latticeKey()): an open-addressing hash.
class BlockTable {
public:
  /// The number of a block, -1 if there is none.
  Index find(std::uint64_t key) const { return entries_.empty() ? -1 : entries_[slotFor(key)].number; }
  /// The number of a block, which is \a next if it had none.
  Index add(std::uint64_t key, Index next);

private:
  struct Entry {
    std::uint64_t key = 0;
    Index number = -1;
  };
  std::size_t slotFor(std::uint64_t key) const;
  void grow();

  std::vector<Entry> entries_;
  std::size_t used_ = 0;
  unsigned shift_ = 54; ///< 2 to the power of 64 less this entries, once there are any
};

/// The field at the lattice vertices of a block that it was asked for.
struct LatticeValues {
  std::array<double, block::kSlots> value; ///< field less the iso level
  std::array<Index, block::kSlots> plane;  ///< see FieldValue
  std::array<BlockMask, 8> meets;          ///< vertices whose plane meets the cell that they are the given corner of (see cube::kCorner)
};

/// A block of the lattice: its cells, and the lattice vertices at their low corners.
struct LatticeBlock {
  LatticeIndex at;                 ///< the block is the lattice's 4 at.i to 4 at.i + 3 and so on
  std::array<Index, block::kForward> forward{}; ///< blocks beside it (see block::kForward), -1 where there is none
  std::array<Index, block::kForward> back{};    ///< the same behind it
  BlockMask visited = 0;           ///< cells that were looked at
  BlockMask surface = 0;           ///< cells with a piece of the surface that no fault divides
  BlockMask asked = 0;             ///< vertices the field was asked for
  BlockMask defined = 0;           ///< and is defined at
  BlockMask inside = 0;            ///< and is less than the iso level at

  LatticeIndex vertex(int slot) const { return block::vertexOf(at, slot); }
};

/// The blocks that the surface passes near, made as it is followed.
class LatticeBlocks {
public:
  std::size_t size() const { return size_; }
  LatticeBlock& operator[](std::size_t b) { return chunks_[b / kChunk][b % kChunk]; }
  const LatticeBlock& operator[](std::size_t b) const { return chunks_[b / kChunk][b % kChunk]; }

  LatticeValues& values(std::size_t b) { return values_[b / kChunk][b % kChunk]; }
  const LatticeValues& values(std::size_t b) const { return values_[b / kChunk][b % kChunk]; }

  /// The block at a block index, -1 if there is none.
  Index find(const LatticeIndex& at) const { return table_.find(latticeKey(at)); }
  /// The same, made if it is not there yet.
  Index make(const LatticeIndex& at);
  /// The forward block, made if it is not there yet.
  Index makeForward(std::size_t b, std::size_t f);
  /// Looks up the forward blocks that have any of some vertices, so that makeForward() need not; for different blocks at once.
  void findForward(std::size_t b, const std::array<BlockMask, block::kForward>& vertices);
  /// For each corner (see cube::kCorner) the cells of a block at whose corner a property of lattice vertices holds.
  /// \param[in] property (block, corner) -> the vertices of the block that have it as that corner; not asked about blocks that do not exist
  template <typename Property>
  std::array<BlockMask, 8> atCorners(std::size_t b, const Property& property) const;
  /// Fills in the blocks beside each block, however they were made.
  void link(unsigned threads);

private:
  static constexpr std::size_t kChunk = 256;

  std::vector<std::unique_ptr<LatticeBlock[]>> chunks_; ///< never moved, so that none is held twice
  std::vector<std::unique_ptr<LatticeValues[]>> values_; ///< apart, so that whoever makes a block does not touch them
  std::size_t size_ = 0;
  BlockTable table_;
};

template <typename Property>
std::array<BlockMask, 8> LatticeBlocks::atCorners(std::size_t b, const Property& property) const {
  const std::array<Index, block::kForward>& next = (*this)[b].forward;
  std::array<BlockMask, 8> result{};
#pragma GCC unroll 8
  for (std::size_t c = 0; c < 8; ++c) {
    constexpr auto corners = cube::kCorner;
    const LatticeIndex at = corners[c];
    const auto reached = static_cast<std::size_t>(4 * at.i + 2 * at.j + at.k);
    std::array<BlockMask, block::kForward> of{};
#pragma GCC unroll 8
    for (std::size_t f = 0; f < block::kForward; ++f)
      if ((f & ~reached) == 0 && next[f] >= 0)
        of[f] = property(static_cast<std::size_t>(next[f]), c);
    result[c] = block::corner(of, at);
  }
  return result;
}

/// A set of cells or vertices per block, for the blocks that have any: what is to be looked at next.
struct BlockSet {
  std::vector<Index> blocks;     ///< in the order they were first added
  std::vector<BlockMask> masks;  ///< of every block of the lattice

  void add(Index b, BlockMask mask) {
    if (mask == 0)
      return;
    const auto i = static_cast<std::size_t>(b);
    if (i >= masks.size())
      masks.resize(i + i / 2 + 64, 0);
    if (masks[i] == 0)
      blocks.push_back(b);
    masks[i] |= mask;
  }
  BlockMask of(Index b) const {
    const auto i = static_cast<std::size_t>(b);
    return i < masks.size() ? masks[i] : 0;
  }
  bool empty() const { return blocks.empty(); }
  void clear() {
    for (const Index b : blocks)
      masks[static_cast<std::size_t>(b)] = 0;
    blocks.clear();
  }
};

} // namespace graben
