#include "graben/core/threads.h"

#include <gtest/gtest.h>

#include <thread>

namespace graben {
namespace {

TEST(Interruption, NoFurtherBlockBeginsOnceAsked) {
  std::atomic<bool> asked{false};
  const InterruptionScope scope(asked);
  std::atomic<std::size_t> done{0};
  EXPECT_THROW(parallelFor(1000000, 10, 2,
                           [&](std::size_t) {
                             asked = true;
                             ++done;
                           }),
               Interrupted);
  EXPECT_GT(done, 0U);
  EXPECT_LE(done, 20U) << "only the blocks under way are finished, one for each thread";
}

TEST(Interruption, AskedBeforehandNothingIsDone) {
  const std::atomic<bool> asked{true};
  const InterruptionScope scope(asked);
  std::atomic<std::size_t> done{0};
  EXPECT_THROW(parallelFor(100, 1, 1, [&](std::size_t) { ++done; }), Interrupted);
  EXPECT_EQ(done, 0U);
}

TEST(Interruption, EndsWithItsScope) {
  const std::atomic<bool> asked{true};
  const std::atomic<bool> not_asked{false};
  std::size_t done = 0;
  {
    const InterruptionScope outer(asked);
    {
      const InterruptionScope inner(not_asked);
      parallelFor(10, 1, 1, [&](std::size_t) { ++done; });
    }
    EXPECT_THROW(parallelFor(10, 1, 1, [&](std::size_t) { ++done; }), Interrupted);
  }
  parallelFor(10, 1, 1, [&](std::size_t) { ++done; });
  EXPECT_EQ(done, 20U);
}

TEST(Interruption, IsOfOneThreadAlone) {
  const std::atomic<bool> asked{true};
  const InterruptionScope scope(asked);
  std::size_t done = 0;
  std::thread([&] { parallelFor(10, 1, 1, [&](std::size_t) { ++done; }); }).join();
  EXPECT_EQ(done, 10U);
}

TEST(Interruption, AnErrorOfABodyGoesFirst) {
  std::atomic<bool> asked{false};
  const InterruptionScope scope(asked);
  EXPECT_THROW(parallelFor(10, 1, 1,
                           [&](std::size_t) {
                             asked = true;
                             throw std::runtime_error("of the body");
                           }),
               std::runtime_error);
}

} // namespace
} // namespace graben
