#include "content/numbers.h"

#include <gtest/gtest.h>

#include <charconv>
#include <cmath>
#include <limits>
#include <random>

namespace graben {
namespace {

std::string written(double value) {
  std::string text;
  appendNumber(text, value);
  return text;
}

/// What the standard library takes for the shortest.
std::string shortest(double value) {
  std::array<char, 400> digits{};
  const auto result = std::to_chars(digits.data(), digits.data() + digits.size(), value, std::chars_format::fixed);
  return {digits.data(), result.ptr};
}

TEST(Numbers, AreWrittenAsShortAsTheyReadBack) {
  for (const double value : {0.0, -0.0, 1.0, -1.5, 100.0, 0.000001, 0.0000015, 123456.789012, 999999999.999999, 1e9, 1e16, 0.1 + 0.2, 5933079.866211,
                             0.3, 2.0000005, 1e-7, 123456789.1234565})
    EXPECT_EQ(written(value), shortest(value));
  EXPECT_EQ(written(-0.25), "-0.25");
  EXPECT_EQ(written(1e30), "1e+30");
  EXPECT_EQ(written(1e-9), "1e-09");
  EXPECT_EQ(written(std::numeric_limits<double>::quiet_NaN()), "nan");
  EXPECT_EQ(written(-std::numeric_limits<double>::infinity()), "-inf");
}

TEST(Numbers, AnyNumberOfDecimalsIsWrittenAsTheStandardLibraryDoes) {
  std::mt19937_64 random(5);
  for (int i = 0; i < 200000; ++i) {
    const double unit = std::pow(10.0, static_cast<double>(random() % 9));
    const double value = std::round(std::ldexp(static_cast<double>(random() >> 11), -53 + static_cast<int>(random() % 31)) * unit) / unit;
    ASSERT_EQ(written(-value), shortest(-value));
    double back = 0.0;
    const std::string text = written(value);
    ASSERT_TRUE(parseField(text, back));
    ASSERT_EQ(back, value);
  }
}

TEST(Numbers, FloatsKeepTheirOwnShortestText) {
  std::string text;
  appendNumber(text, 0.1F);
  appendNumber(text, -16777216.0F);
  EXPECT_EQ(text, "0.1-16777216");
}

} // namespace
} // namespace graben
