#include "graben/core/ticks.h"

#include <gtest/gtest.h>

namespace graben {
namespace {

TEST(Ticks, RoundNumbers) {
  EXPECT_DOUBLE_EQ(roundDown125(1.0), 1.0);
  EXPECT_DOUBLE_EQ(roundDown125(4.9), 2.0);
  EXPECT_DOUBLE_EQ(roundDown125(999.0), 500.0);
  EXPECT_DOUBLE_EQ(roundDown125(0.02), 0.02);
}

TEST(Ticks, StayInsideAndAreFew) {
  for (const auto& [low, high] : {std::pair{0.0, 1.0}, {-1713.2, -1500.9}, {5.93e6, 5.94e6}, {-1e-7, 3e-7}}) {
    const std::vector<double> ticks = niceTicks(low, high, 8);
    EXPECT_GE(ticks.size(), 3U);
    EXPECT_LE(ticks.size(), 9U);
    EXPECT_GE(ticks.front(), low - 1e-9 * (high - low));
    EXPECT_LE(ticks.back(), high + 1e-6 * (high - low));
  }
  EXPECT_EQ(niceTicks(3.0, 3.0, 8), std::vector<double>{3.0});
}

TEST(Ticks, TextHasTheDigitsOfTheStep) {
  EXPECT_EQ(tickText(1500.0, 500.0), "1500");
  EXPECT_EQ(tickText(0.25, 0.05), "0.25");
  EXPECT_EQ(tickText(5932000.0, 2000.0), "5932000");
}

} // namespace
} // namespace graben
