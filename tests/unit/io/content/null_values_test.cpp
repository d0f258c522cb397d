// What stands for "no data" and what is a true depth.
#include "pick_samples.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace graben {
namespace {

using test::readText;
using testing::Contains;
using testing::HasSubstr;

/// 400 nodes around z = -2000, every fifth of which is without data.
std::string gridWithNulls(const std::string& code, double middle = -2000.0) {
  std::string text;
  for (int i = 0; i < 400; ++i)
    text += std::to_string(i % 20) + ".5 " + std::to_string(i / 20) + ".5 " + (i % 5 == 2 ? code : std::to_string(middle + 0.5 * (i % 20))) + "\n";
  return text;
}

TEST(NullValues, CustomaryCodesAreDroppedAndNamed) {
  for (const char* code : {"9999900", "-9999900.000000", "1.00000E+20", "-1.0E+10",       "-9999.99", "-9999.990234", "-999999.0",  "999999",
                           "99999",   "-99999",          "99999.9961",  "32767.0",        "-32768",   "0.00",         "-999.25",    "999.25",
                           "-999",    "-9999",           "1e30",        "-3.4028235E+38", "UNDEF",    "nan",          "1.70141E+38"}) {
    const PickSet picks = readText(gridWithNulls(code));
    EXPECT_EQ(picks.points.size(), 320U) << code;
    EXPECT_EQ(picks.no_data_rows, 80U) << code;
    EXPECT_THAT(picks.notes, Contains(HasSubstr("80 rows without data (null"))) << code;
  }
}

TEST(NullValues, AValueRepeatedVeryOftenFarOutsideIsOne) {
  const PickSet picks = readText(gridWithNulls("-123456"));
  EXPECT_EQ(picks.points.size(), 320U);
  ASSERT_EQ(picks.nulls.size(), 1U);
  EXPECT_EQ(picks.nulls[0].value, -123456.0);
  EXPECT_EQ(picks.nulls[0].rows, 80U);
  EXPECT_EQ(readText(gridWithNulls("-2500")).points.size(), 400U); // a flat block may lie there
  EXPECT_EQ(readText(gridWithNulls("-2000")).points.size(), 400U);
}

TEST(NullValues, SeveralCodesInOneFile) {
  std::string text = gridWithNulls("9999900");
  for (const char* code : {"-999.25", "1e30", "-99999", "0"})
    for (int i = 0; i < 3; ++i)
      text += "3.5 4.5 " + std::string(code) + "\n";
  EXPECT_EQ(readText(text).points.size(), 320U);
}

TEST(NullValues, ATrueDepthAmongLikeOnesIsKept) {
  EXPECT_EQ(readText("0 0 999.25\n1 0 999.5\n0 1 999.25\n1 1 999.5\n").points.size(), 4U);
  EXPECT_EQ(readText(gridWithNulls("0", 3.0)).points.size(), 400U);
  EXPECT_EQ(readText(gridWithNulls("-9999", -9990.0)).points.size(), 400U);
  EXPECT_EQ(readText(gridWithNulls("32767", 32760.0)).points.size(), 400U);
  EXPECT_EQ(readText("0 0 -2000\n1 0 -2000\n0 1 -2100\n1 1 -2100\n0 2 -2000\n").points.size(), 5U);
}

TEST(NullValues, WhatTheUserAndTheHeaderNameIsDroppedAnywhere) {
  ReadOptions options;
  options.nulls = {-2000.0};
  EXPECT_EQ(readText(gridWithNulls("-2000"), "a.xyz", options).points.size(), 300U); // 20 others are -2000 too
  options.nulls.clear();
  options.recognise_nulls = false;
  EXPECT_EQ(readText(gridWithNulls("0"), "a.xyz", options).points.size(), 400U);
  EXPECT_EQ(readText("# Field: 1 x\n# Field: 2 y\n# Field: 3 z meters\n# Null_value: -1990\n# End:\n1 2 -2000\n3 4 -1990\n").points.size(), 1U);
}

TEST(NullValues, NullPlacesAreDropped) {
  std::string text = "0 0 0\n0 0 0\n";
  for (int i = 0; i < 100; ++i)
    text += std::to_string(461000 + i % 10) + ".5 " + std::to_string(5931000 + i / 10) + ".5 -2000\n";
  const PickSet picks = readText(text);
  EXPECT_EQ(picks.points.size(), 100U);
  EXPECT_EQ(readText("0 0 0\n1 0 0.5\n0 1 0.25\n").points.size(), 3U);
}

} // namespace
} // namespace graben
