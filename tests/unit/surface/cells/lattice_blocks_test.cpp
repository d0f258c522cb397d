#include "cells/lattice_blocks.h"

#include "shapes.h"

#include <gtest/gtest.h>

#include <map>
#include <vector>

namespace graben {
namespace {

/// Whether a lattice vertex, or cell, near a block at (0,0,0) is a member of the masks of that block and of those one step forward (or back).
bool isMember(const std::array<BlockMask, block::kForward>& masks, const LatticeIndex& p, int direction) {
  const LatticeIndex at = block::blockOf(p);
  const auto f = static_cast<std::size_t>(direction * (4 * at.i + 2 * at.j + at.k));
  return (masks[f] & block::bit(block::slotOf(p))) != 0;
}

std::array<BlockMask, block::kForward> randomMasks(unsigned seed) {
  test::Random random(seed);
  std::array<BlockMask, block::kForward> masks{};
  for (BlockMask& mask : masks)
    for (int slot = 0; slot < block::kSlots; ++slot)
      if (random.uniform(0.0, 1.0) < 0.4)
        mask |= block::bit(slot);
  return masks;
}

TEST(BlockMasks, CountAndRankAreThoseOfTheSlotsInTurn) {
  for (const BlockMask mask : randomMasks(1)) {
    Index before = 0;
    for (int slot = 0; slot < block::kSlots; ++slot) {
      EXPECT_EQ(block::rank(mask, slot), before);
      before += (mask & block::bit(slot)) != 0 ? 1 : 0;
    }
    EXPECT_EQ(block::count(mask), before);
  }
}

TEST(BlockMasks, CornersAndCellsAreThoseOneStepFurtherAndBack) {
  const std::array<BlockMask, block::kForward> masks = randomMasks(2);
  for (std::size_t f = 0; f < block::kForward; ++f) {
    const LatticeIndex step = block::forward(f);
    const BlockMask corner = block::corner(masks, step);
    const BlockMask cell = block::cellWithCorner(masks, step);
    for (int slot = 0; slot < block::kSlots; ++slot) {
      const LatticeIndex p = block::inBlock(slot);
      EXPECT_EQ((corner & block::bit(slot)) != 0, isMember(masks, p + step, 1)) << f << ' ' << slot;
      EXPECT_EQ((cell & block::bit(slot)) != 0, isMember(masks, p - step, -1)) << f << ' ' << slot;
    }
  }
}

TEST(BlockMasks, CellsAroundAnEdgeAreTheFourThatShareIt) {
  const BlockMask edges = randomMasks(4)[0] & randomMasks(5)[1];
  for (std::size_t along = 0; along < 3; ++along) {
    std::array<BlockMask, block::kForward> expected{};
    for (int slot = 0; slot < block::kSlots; ++slot)
      for (const LatticeIndex& corner : cube::kCorner) {
        if ((edges & block::bit(slot)) == 0 || std::array<int, 3>{corner.i, corner.j, corner.k}[along] != 0)
          continue;
        const LatticeIndex cell = block::inBlock(slot) - corner;
        const LatticeIndex at = block::blockOf(cell);
        expected[static_cast<std::size_t>(-(4 * at.i + 2 * at.j + at.k))] |= block::bit(block::slotOf(cell));
      }
    EXPECT_EQ(block::cellsAround(edges, along), expected) << along;
  }
}

TEST(BlockMasks, LayersAreThoseBetweenTwoIndices) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (int first = 0; first < 4; ++first)
      for (int last = -1; last < 4; ++last)
        for (int slot = 0; slot < block::kSlots; ++slot) {
          const LatticeIndex p = block::inBlock(slot);
          const int at = std::array<int, 3>{p.i, p.j, p.k}[axis];
          EXPECT_EQ((block::layers(axis, first, last) & block::bit(slot)) != 0, at >= first && at <= last);
        }
}

TEST(BlockMasks, CornersOfCellsAreTheirEightVertices) {
  const BlockMask cells = randomMasks(3)[0];
  std::array<BlockMask, block::kForward> expected{};
  for (int slot = 0; slot < block::kSlots; ++slot)
    for (std::size_t c = 0; (cells & block::bit(slot)) != 0 && c < 8; ++c) {
      const LatticeIndex corner = block::inBlock(slot) + cube::kCorner[c];
      const LatticeIndex at = block::blockOf(corner);
      expected[static_cast<std::size_t>(4 * at.i + 2 * at.j + at.k)] |= block::bit(block::slotOf(corner));
    }
  EXPECT_EQ(block::cornersOf(cells), expected);
}

TEST(BlockTable, FindsWhatAMapFinds) {
  test::Random random(4);
  std::map<std::uint64_t, Index> expected;
  BlockTable table;
  EXPECT_EQ(table.find(0), -1);
  for (Index next = 0; next < 5000; ++next) {
    const auto near = [&random] { return static_cast<std::int32_t>(random.uniform(-12.0, 12.0)); };
    const std::uint64_t key = latticeKey({near(), near(), near()});
    EXPECT_EQ(table.add(key, next), expected.emplace(key, next).first->second);
  }
  for (std::int32_t i = -13; i <= 13; ++i)
    for (std::int32_t j = -13; j <= 13; ++j)
      for (std::int32_t k = -13; k <= 13; ++k) {
        const auto found = expected.find(latticeKey({i, j, k}));
        EXPECT_EQ(table.find(latticeKey({i, j, k})), found == expected.end() ? -1 : found->second);
      }
}

TEST(LatticeBlocks, KnowTheirNeighboursHoweverTheyWereMade) {
  test::Random random(5);
  LatticeBlocks blocks;
  for (int n = 0; n < 600; ++n) {
    const auto near = [&random] { return static_cast<std::int32_t>(random.uniform(-6.0, 6.0)); };
    const Index b = blocks.make({near(), near(), near()});
    if (n % 3 == 0)
      blocks.makeForward(static_cast<std::size_t>(b), static_cast<std::size_t>(n / 3) % block::kForward);
  }
  blocks.link(2);
  ASSERT_GT(blocks.size(), 300u) << "more than one chunk of blocks";
  for (std::size_t b = 0; b < blocks.size(); ++b)
    for (std::size_t f = 0; f < block::kForward; ++f) {
      EXPECT_EQ(blocks[b].forward[f], blocks.find(blocks[b].at + block::forward(f)));
      EXPECT_EQ(blocks[b].back[f], blocks.find(blocks[b].at - block::forward(f)));
    }
}

} // namespace
} // namespace graben
