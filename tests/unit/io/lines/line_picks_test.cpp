// Horizons along seismic lines (Charisma, IESX), GOCAD sets and clouds whose header contradicts them.
#include "pick_samples.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace graben {
namespace {

using test::readFailure;
using test::readText;
using testing::Contains;
using testing::HasSubstr;

const Points two = {{461000, 5931000, -1800.5}, {461025, 5931000, -1801}};

TEST(LinePicks, ReadsIesx) {
  const std::string block = "PROFILE Top A   TYPE 1  5 x.hor ft ms\nSNAPPING PARAMETERS 5 0 1\n"
                            "  4.61000000E+05  5.93100000E+06  1 14  -1800.50  1030.00  2060.00  914\n"
                            "  4.61025000E+05  5.93100000E+06  1 14  -1801.00  1031.00  2060.00  914\nEOD\n";
  const PickSet picks = readText(block);
  EXPECT_EQ(picks.points, two);
  EXPECT_EQ(picks.horizon, "Top A");
  EXPECT_EQ(picks.xy_unit, "ft");
  EXPECT_EQ(picks.z_unit, "ms");
  EXPECT_THAT(readFailure(block + "PROFILE Base TYPE 1 5 x m m\n 1 2 1 14 3\nEOD\n"), HasSubstr("holds 2 horizons: Top A, Base"));
  EXPECT_EQ(readText(block + block).points.size(), 4U);
  EXPECT_THAT(readFailure("PROFILE F1 TYPE 1 3 a_fault.ifdf m ms\n 1 2 1 14 3\nEOD\n"), HasSubstr("--fault"));
  EXPECT_THAT(readFailure("PROFILE Top TYPE 1 5 x m m\n 1 2 1 14\nEOD\n"), HasSubstr("picks.dat:2: no IESX row"));
}

TEST(LinePicks, ReadsCharismaHorizons) {
  const std::string rows = "INLINE :  784 XLINE :  604  461000.0 5931000.0 -1800.5\nINLINE :  784 XLINE :  606  461025.0 5931000.0 -1801.0\n";
  EXPECT_EQ(readText(rows).points, two);
  EXPECT_THAT(readFailure("INLINE-  784  604  461000.0 5931000.0 1500.0 F1 1\n"), HasSubstr("--fault"));
  EXPECT_THAT(readFailure("INLINE :  784 XLINE :  604  461000.0 5931000.0\n"), HasSubstr("picks.dat:1: "));
}

std::string inUtf16(const std::string& ascii, bool big_endian, bool mark) {
  std::string bytes = !mark ? "" : big_endian ? "\xFE\xFF" : "\xFF\xFE";
  for (const char c : ascii)
    bytes += big_endian ? std::string{'\0', c} : std::string{c, '\0'};
  return bytes;
}

TEST(LinePicks, AnyEncodingAndLineEnds) {
  const std::string text = "X,Y,Z\r\n461000,5931000,-1800.5\r\n461025,5931000,-1801\r\n";
  for (const bool big : {false, true})
    for (const bool mark : {false, true})
      EXPECT_EQ(readText(inUtf16(text, big, mark), "a.csv").points, two);
  EXPECT_EQ(readText("\xEF\xBB\xBF" + text, "a.csv").points, two);
  EXPECT_EQ(readText("X,Y,Z\r461000,5931000,-1800.5\r461025,5931000,-1801\r", "a.csv").points, two);
  EXPECT_EQ(readText("4.61D+05 5.931d6 -1800.5\n461025. +5.931E+06 -1801.\n").points, two);
  EXPECT_EQ(readText(inUtf16("GOCAD VSet 1\nVRTX 1 461000 5931000 -1800.5\nVRTX 2 461025 5931000 -1801\nEND\n", false, true), "a.vs").points, two);
}

TEST(LinePicks, GocadSetsOfSeveralHorizonsAreToldApart) {
  const auto set = [](const std::string& name, const std::string& z) {
    return "GOCAD VSet 1\nHEADER {\nname:" + name + "\n}\nAXIS_UNIT \"m\" \"m\" \"ft\"\nZPOSITIVE Depth\nVRTX 1 1 2 " + z + "\nEND\n";
  };
  EXPECT_THAT(readFailure(set("A", "3") + set("B", "4")), HasSubstr("holds 2 horizons: A, B"));
  EXPECT_EQ(readText(set("A", "3") + set("A", "4")).points.size(), 2U);
  ReadOptions options;
  options.horizon = "B";
  const PickSet b = readText(set("A", "3") + set("B", "4"), "h.vs", options);
  EXPECT_EQ(b.points, (Points{{1, 2, 4}}));
  EXPECT_EQ(b.z_unit, "ft");
  EXPECT_EQ(b.z_positive, ZPositive::Down);
  EXPECT_TRUE(b.warnings.empty());
  const std::string cut = set("A", "3");
  EXPECT_THAT(readText(cut.substr(0, cut.size() - 4)).warnings, Contains(HasSubstr("has no END")));
}

TEST(LinePicks, CloudsWhoseHeaderContradictsThemAreRefused) {
  const auto pcd = [](const std::string& size, const std::string& data) {
    return "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n" + size + "\nDATA " + data;
  };
  const std::string rows = "ascii\n1 2 3\n4 5 6\n7 8 9\n";
  EXPECT_EQ(readText(pcd("WIDTH 3\nHEIGHT 1\nPOINTS 3", rows), "a.pcd").points.size(), 3U);
  EXPECT_THAT(readFailure(pcd("WIDTH 2\nHEIGHT 1\nPOINTS 2", rows), "a.pcd"), HasSubstr("promises 2 POINTS but the file holds 3"));
  EXPECT_THAT(readFailure(pcd("WIDTH 2\nHEIGHT 2\nPOINTS 3", rows), "a.pcd"), HasSubstr("WIDTH 2 x HEIGHT 2 are not the 3 POINTS"));
  const std::string binary = "binary\n" + std::string(24, 'a');
  EXPECT_EQ(readText(pcd("WIDTH 2\nHEIGHT 1\nPOINTS 2", binary), "a.pcd").points.size(), 2U);
  EXPECT_EQ(readText(pcd("WIDTH 2\nHEIGHT 1\nPOINTS 2", binary + std::string(100, '\0')), "a.pcd").points.size(), 2U);
  EXPECT_THAT(readFailure(pcd("WIDTH 1\nHEIGHT 1\nPOINTS 1", binary), "a.pcd"), HasSubstr("promises 1 POINTS but the file holds 2"));
}

} // namespace
} // namespace graben
