#include "graben/core/threads.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

namespace graben {
namespace {

TEST(Threads, EveryIndexIsVisitedOnceForAnyThreadCount) {
  for (const unsigned threads : {0U, 1U, 3U, 8U})
    for (const std::size_t count :
         {std::size_t{0}, std::size_t{1}, std::size_t{7}, std::size_t{1000}}) {
      std::vector<int> visits(count, 0);
      parallelFor(count, 7, threads, [&visits](std::size_t i) { ++visits[i]; });
      EXPECT_EQ(visits, std::vector<int>(count, 1));
    }
}

TEST(Threads, BlockLimitsDependOnTheGrainAlone) {
  std::vector<std::size_t> begins(4, 99);
  parallelBlocks(10, 3, 4, [&begins](std::size_t begin, std::size_t end) {
    begins[begin / 3] = begin;
    EXPECT_EQ(end, std::min<std::size_t>(10, begin + 3));
  });
  EXPECT_EQ(begins, (std::vector<std::size_t>{0, 3, 6, 9}));
}

TEST(Threads, WhatBlocksFindIsJoinedInTheirOrder) {
  std::vector<std::size_t> odd;
  for (std::size_t i = 1; i < 1000; i += 2)
    odd.push_back(i);
  for (const unsigned threads : {0U, 1U, 3U, 8U})
    EXPECT_EQ(joinBlocks<std::size_t>(1000, 7, threads,
                                      [](std::size_t begin, std::size_t end, std::vector<std::size_t>& found) {
                                        for (std::size_t i = begin; i < end; ++i)
                                          if (i % 2 == 1)
                                            found.push_back(i);
                                      }),
              odd);
  EXPECT_TRUE(joinBlocks<int>(0, 7, 2, [](std::size_t, std::size_t, std::vector<int>& found) { found.push_back(1); }).empty());
}

TEST(Threads, AnExceptionReachesTheCaller) {
  EXPECT_THROW(parallelFor(100, 1, 4,
                           [](std::size_t i) {
                             if (i == 42)
                               throw std::runtime_error("stop");
                           }),
               std::runtime_error);
}

TEST(Threads, ZeroAsksForOnePerProcessor) {
  EXPECT_GE(threadCount(0), 1U);
  EXPECT_EQ(threadCount(5), 5U);
}

} // namespace
} // namespace graben
