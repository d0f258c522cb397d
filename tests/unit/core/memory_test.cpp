#include "graben/core/memory.h"

#include <gtest/gtest.h>

#include <vector>

namespace graben {
namespace {

/// An instrumented allocator keeps what is freed, to tell later uses of it.
bool allocatorKeepsMemory() {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  return true;
#else
  return false;
#endif
}

TEST(Memory, GrowsWithWhatIsInUseAndThePeakStays) {
  if (allocatorKeepsMemory())
    GTEST_SKIP() << "memory that is freed is kept by the sanitizer";
  const std::size_t before = residentMemory();
  ASSERT_GT(before, std::size_t{1} << 20);
  constexpr std::size_t kBytes = std::size_t{64} << 20;
  {
    const std::vector<char> block(kBytes, 1);
    EXPECT_GT(residentMemory(), before + kBytes / 2);
    EXPECT_EQ(block.back(), 1);
  }
  EXPECT_LT(residentMemory(), before + kBytes / 2);
  EXPECT_GT(peakResidentMemory(), before + kBytes / 2);
}

TEST(Memory, WhatIsFreeGoesBackToTheSystem) {
  if (allocatorKeepsMemory())
    GTEST_SKIP() << "memory that is freed is kept by the sanitizer";
  constexpr std::size_t kBlocks = 1 << 16, kBytes = 1024;
  const std::size_t before = residentMemory();
  std::vector<std::vector<char>> blocks(kBlocks);
  for (std::vector<char>& block : blocks)
    block.assign(kBytes, 'x');
  const std::vector<char> last(kBytes, 'x'); // keeps the heap from shrinking by itself
  blocks = {};
  releaseFreeMemory();
#ifdef __GLIBC__
  EXPECT_LT(residentMemory(), before + kBlocks * kBytes / 4);
#endif
}

TEST(Memory, TheLimitIsBelowWhatTheMachineHas) {
  EXPECT_GT(defaultMemoryLimit(), residentMemory());
}

} // namespace
} // namespace graben
