// What ends the sticks of a fault in a table, where it is not three times 999, and what tells them
// where nothing ends them.
#include "stick_samples.h"

#include <gmock/gmock.h>

namespace graben {
namespace {

using test::expectSampleSticks;
using test::faultFailure;
using test::NodeText;
using test::readFaultText;
using test::stickRows;
using testing::Contains;
using testing::HasSubstr;
using testing::SizeIs;

std::string plainRow(const NodeText& n) {
  return n.x + " " + n.y + " " + n.z;
}

TEST(StickEnds, AreNullCodesEmptyFieldsAndTexts) {
  for (const char* end :
       {"9999.0 9999.0 9999.0", "-999 -999 -999", "1e30 1e30 1e30", "999.25 999.25 999.25", "0 0 0",
        "nan nan nan", "9.99E+02 9.99E+02 9.99E+02", "NULL NULL NULL", "# next", "END", "-----",
        "*", "&", "Stick", "> 1", "", "\t"}) {
    SCOPED_TRACE(end);
    const auto faults = readFaultText(stickRows(plainRow, std::string(end) + "\n"));
    ASSERT_THAT(faults, SizeIs(1));
    expectSampleSticks(faults[0]);
  }
}

TEST(StickEnds, AreEmptyFieldsOfSpreadsheets) {
  for (const std::string separator : {",", ";"}) {
    SCOPED_TRACE(separator);
    const auto row = [&](const NodeText& n) { return n.x + separator + n.y + separator + n.z; };
    const auto faults = readFaultText("X" + separator + "Y" + separator + "Z\n" +
                                      stickRows(row, separator + separator + "\n"));
    ASSERT_THAT(faults, SizeIs(1));
    expectSampleSticks(faults[0]);
  }
}

TEST(StickEnds, MayHaveFewerColumnsThanRows) {
  const auto faults = readFaultText(
      stickRows([](const NodeText& n) { return std::to_string(n.node) + " " + plainRow(n); },
                "999 999 999\n"));
  ASSERT_THAT(faults, SizeIs(1));
  expectSampleSticks(faults[0]);
}

TEST(StickEnds, AreNoSinglePointAtZero) {
  const auto faults = readFaultText("0 0 0\n1 2 -10\n999 999 999\n5 0 0\n6 2 -10\n999 999 999\n");
  const auto& sticks = std::get<std::vector<FaultStick>>(faults.at(0).geometry);
  ASSERT_THAT(sticks, SizeIs(2));
  EXPECT_THAT(sticks[0].points, SizeIs(2));
}

TEST(StickEnds, AreNoTextsWhereColumnsTellTheSticks) {
  const std::string rows =
      stickRows([](const NodeText& n) { return plainRow(n) + " " + std::to_string(n.stick); });
  EXPECT_THAT(faultFailure(rows + "END OF FILE\n" + rows),
              HasSubstr("no row x y z of a fault stick: 'END OF FILE'"));
}

TEST(SticksWithoutEnds, AreToldWhereZTurnsBack) {
  const auto faults = readFaultText(stickRows(plainRow));
  ASSERT_THAT(faults, SizeIs(1));
  expectSampleSticks(faults[0]);
  EXPECT_THAT(faults[0].notes, Contains(HasSubstr("5 sticks told apart where z turns back")));
}

TEST(SticksWithoutEnds, ArePointsWhereTheyRunToAndFro) {
  std::string rows;
  for (int s = 0; s < 6; ++s)
    for (int n = 0; n < 4; ++n)
      rows += std::to_string(10 * n) + " " + std::to_string(20 * s) + " " +
              std::to_string(-1000 - 100 * (s % 2 == 0 ? n : 3 - n)) + "\n";
  const auto faults = readFaultText(rows);
  ASSERT_EQ(faults.at(0).geometry.index(), 0u);
  EXPECT_THAT(std::get<TriangleMesh>(faults[0].geometry).vertices, SizeIs(24));
}

TEST(SticksWithoutEnds, AreOneTraceWhereTheyLieFlat) {
  std::string rows;
  for (int i = 0; i < 40; ++i)
    rows += std::to_string(100 * i) + " " + std::to_string(3 * i) + " " +
            std::to_string(-2000 + (i % 4)) + "\n";
  EXPECT_THAT(std::get<std::vector<FaultStick>>(readFaultText(rows).at(0).geometry), SizeIs(1));
}

TEST(SticksByName, AreTakenFromColumnsOfIdsWhateverTheirName) {
  for (const char* name : {"id", "FID", "ORIG_FID", "group", "shapeid", "line_no", "Nr"}) {
    SCOPED_TRACE(name);
    const auto row = [](const NodeText& n) {
      return std::to_string(n.stick) + "," + n.x + "," + n.y + "," + n.z;
    };
    const auto faults = readFaultText(std::string(name) + ",X,Y,Z\n" + stickRows(row));
    ASSERT_THAT(faults, SizeIs(1));
    expectSampleSticks(faults[0]);
  }
}

TEST(SticksByName, AreOneFaultWhereTheNamesCountThem) {
  for (const char* name : {"F1_", "Line ", "F1-", "stick", "L"}) {
    SCOPED_TRACE(name);
    const auto row = [&](const NodeText& n) {
      return name + std::to_string(n.stick) + "," + n.x + "," + n.y + "," + n.z;
    };
    const auto faults = readFaultText("name,X,Y,Z\n" + stickRows(row));
    ASSERT_THAT(faults, SizeIs(1));
    expectSampleSticks(faults[0]);
  }
  const auto row = [&](const NodeText& n) {
    return "F" + std::to_string(n.stick) + "," + n.x + "," + n.y + "," + n.z;
  };
  EXPECT_THAT(readFaultText("name,X,Y,Z\n" + stickRows(row)), SizeIs(5)) << "F1 to F5 are faults";
}

TEST(SticksByContent, HaveNumberOfStickAndNodeBeforeX) {
  const auto row = [](const NodeText& n) {
    return std::to_string(n.stick) + "," + std::to_string(n.node) + "," + n.x + "," + n.y + "," +
           n.z;
  };
  const auto faults = readFaultText(stickRows(row));
  ASSERT_THAT(faults, SizeIs(1));
  expectSampleSticks(faults[0]);
}

TEST(SticksByContent, AreNamedByTheTextThatSeveralHaveInCommon) {
  const auto row = [](const NodeText& n) {
    return "L" + std::to_string(1000 + n.stick) + " " + std::to_string(2000 + n.node) + " " +
           plainRow(n) + " F1 " + std::to_string(n.stick);
  };
  const auto faults = readFaultText(stickRows(row));
  ASSERT_THAT(faults, SizeIs(1));
  EXPECT_EQ(faults[0].name, "F1");
  expectSampleSticks(faults[0]);
}

TEST(SticksOfIesx, BeginWhereTheCodeSaysSo) {
  const auto row = [](const NodeText& n) {
    return n.x + " " + n.y + " 1 " + (n.node == 1 ? "6" : n.last ? "8" : "7") + " " + n.z;
  };
  const auto faults = readFaultText("PROFILE F1               TYPE 1  3      fault_gf.ifdf    m "
                                    "ms\nSNAPPING PARAMETERS 5     0 1\n" +
                                    stickRows(row) + "EOD\n");
  ASSERT_THAT(faults, SizeIs(1));
  expectSampleSticks(faults[0]);
}

TEST(SticksCutShort, LoseTheHalfRow) {
  std::string rows = stickRows(plainRow, "999.00 999.00 999.00\n");
  rows.resize(rows.rfind("\n999.00") - 3); // the last node's z loses its decimals
  const auto faults = readFaultText(rows);
  const auto& sticks = std::get<std::vector<FaultStick>>(faults.at(0).geometry);
  ASSERT_THAT(sticks, SizeIs(5));
  EXPECT_THAT(sticks.back().points, SizeIs(3));
  EXPECT_THAT(faults[0].warnings, Contains(HasSubstr("may be cut short")));
}

TEST(Sticks, WithSmallWholeNumbersForPlacesAreWarnedOf) {
  const auto row = [](const NodeText& n) {
    return std::to_string(1000 + n.stick) + " " + std::to_string(2000 + n.node) + " " + n.z;
  };
  EXPECT_THAT(readFaultText(stickRows(row, "999 999 999\n")).at(0).warnings,
              Contains(HasSubstr("inline and crossline")));
}

} // namespace
} // namespace graben
