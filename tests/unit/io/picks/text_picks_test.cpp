#include "graben/core/errors.h"
#include "graben/io/pick_reader.h"
#include "graben/io/pick_writer.h"
#include "support/temp_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace graben {
namespace {

using test::TempFolder;
using testing::Contains;
using testing::HasSubstr;

PickSet read(const std::string& content, const std::string& name = "picks.xyz") {
  const TempFolder folder;
  return readPicks(folder.write(name, content));
}

/// The message of the ParseError that reading gives; empty if there is none.
std::string failure(const std::string& content, const std::string& name = "picks.xyz") {
  try {
    read(content, name);
  } catch (const ParseError& error) {
    return error.what();
  }
  return {};
}

const Points three = {{1.5, 2.5, 3.5}, {4, 5, 6}, {7, 8, 9}};

TEST(TextPicks, readsEverySeparator) {
  EXPECT_EQ(read("1.5 2.5 3.5\n4 5 6\n7 8 9\n").points, three);
  EXPECT_EQ(read("1.5\t2.5\t3.5\n4\t5\t6\n7\t8\t9").points, three);
  EXPECT_EQ(read("1.5,2.5,3.5\n4, 5, 6\n7,8,9\n").points, three);
  EXPECT_EQ(read("1.5;2.5;3.5\r\n4;5;6\r\n7;8;9\r\n").points, three);
  EXPECT_EQ(read("   1.5    2.5 \t 3.5  \n\n 4 5   6\n7 8 9   \n\n").points, three);
  EXPECT_EQ(read("\xEF\xBB\xBF"
                 "1.5 2.5 3.5\r4 5 6\r7 8 9\r")
                .points,
            three);
}

TEST(TextPicks, readsNumbersAsProgramsWriteThem) {
  const PickSet picks = read("+1.5D+00 2.5d0 3.5E+0\n4. .5e1 6\n0.7e+01 8 9\n");
  EXPECT_EQ(picks.points, three);
}

TEST(TextPicks, keepsUtmCoordinatesToTheLastBit) {
  const Points utm = {{460288.234863, 5933079.866211, 1658.767822},
                      {0.1 + 0.2, -1.0 / 3.0, 6e6 + 1e-9}};
  const TempFolder folder;
  const std::string path = folder.path("utm.xyz");
  writeXyz(path, utm);
  EXPECT_EQ(readPicks(path).points, utm);
}

TEST(TextPicks, findsColumnsByName) {
  EXPECT_EQ(
      read("Z_TVDSS,X_UTME,POLY_ID,Y_UTMN\n3.5,1.5,0,2.5\n6,4,0,5\n9,7,1,8\n", "a.csv").points,
      three);
  EXPECT_EQ(read("# \"X\"\t\"Y\"\t\"Inline\"\t\"Crossline\"\t\"Z\"\n# - - - -\n"
                 "1.5\t2.5\t1\t2\t3.5\n4\t5\t1\t2\t6\n7\t8\t1\t2\t9\n")
                .points,
            three);
  EXPECT_EQ(
      read("# 1: X\n# 2: Y\n# 3: Seed Index\n# 4: Z\n# - -\n1.5 2.5 8 3.5\n4 5 8 6\n7 8 8 9\n")
          .points,
      three);
  EXPECT_EQ(read("# Type: scattered data\n# Field: 1 x\n# Field: 2 y\n# Field: 3 column\n# Field: "
                 "4 z meters\n"
                 "# Null_value: 1.0e30\n# End:\n1.5 2.5 8 3.5\n4 5 8 6\n7 8 9 1e30\n7 8 8 9\n",
                 "e.dat")
                .points,
            three);
  EXPECT_EQ(read("//X Y Z R G B\n1.5 2.5 3.5 0 0 0\n4 5 6 0 0 0\n7 8 9 0 0 0\n").points, three);
}

TEST(TextPicks, takesTheNameColumnOfExportsOfSeveralHorizons) {
  const PickSet picks = read("# \"X\"\t\"Y\"\t\"Inline\"\t\"Z\"\n\"Top A\"\t1.5\t2.5\t9\t3.5\n"
                             "\"Top A\"\t4\t5\t9\t6\n\"Top B\"\t7\t8\t9\t9\n");
  EXPECT_EQ(picks.points, three);
}

TEST(TextPicks, saysWhichColumnsItTook) {
  EXPECT_THAT(read("x,y,inline,z\n1,2,3,4\n").notes, Contains(HasSubstr("ignored: inline")));
  EXPECT_THAT(read("1 2 3 4 5\n").notes, Contains(HasSubstr("columns 1, 2, 3 of 5")));
  EXPECT_THAT(failure("x,y,inline,crossline\n1,2,3,4\n"), HasSubstr("none for z"));
}

TEST(TextPicks, dropsLineEndsAndNullValuesWithACount) {
  const PickSet picks = read("1.5 2.5 3.5\n4 5 6\n1 1 1e30\n1 1 -999.25\n1 1 UNDEF\n1 nan 1\n"
                             "999 999 999\n7 8 9\n999.000 999.000 999.000\n");
  EXPECT_EQ(picks.points, three);
  EXPECT_EQ(picks.no_data_rows, 4U);
  EXPECT_THAT(picks.notes, Contains(HasSubstr("4 rows without data")));
  EXPECT_THAT(picks.notes, Contains(HasSubstr("2 rows 999 999 999")));
}

TEST(TextPicks, takesDoubtfulNullsForDataOnlyAmongLikeValues) {
  EXPECT_EQ(read("1 1 -990\n2 2 -999\n3 3 -1010\n").points.size(), 3U);
  EXPECT_EQ(read("1 1 1800\n2 2 -999\n3 3 1810\n").points.size(), 2U);
}

TEST(TextPicks, dropsEachNullValueOnItsOwn) {
  for (const char* row : {"1 1 1e30", "1 1 -1e31", "1 1 999.25", "1 1 -999.25", "1 1 -99999", "1 1 -9999", "1 1 -999", "1 1 nan", "1e30 1 1",
                          "1 -inf 1", "999 999 999"})
    EXPECT_EQ(read(std::string("1.5 2.5 3.5\n") + row + "\n4 5 6\n7 8 9\n").points, three) << row;
}

TEST(TextPicks, emptyFieldsAreNoDataAndDoNotShiftColumns) {
  const PickSet picks = read("x,y,z,q\n1.5,2.5,3.5,1\n4,5,,6\n4,5,6,\n7,8,9,1\n");
  EXPECT_EQ(picks.points, three);
  EXPECT_EQ(picks.no_data_rows, 1U);
  EXPECT_EQ(read("1.5\t2.5\t3.5\t1\n4\t5\t\t6\n4\t5\t6\t1\n7\t8\t9\t1\n").points, three);
}

TEST(TextPicks, knowsTheSignOfRmsPointsWhereAllAgree) {
  EXPECT_EQ(read("1 2 0.5\n4 5 6\n999 999 999\n", "a.poi").z_positive, ZPositive::Down);
  EXPECT_EQ(read("1 2 -3\n4 5 -6\n", "a.ipts").z_positive, ZPositive::Up);
  EXPECT_EQ(read("1 2 -3\n4 5 6\n", "a.poi").z_positive, ZPositive::Unknown);
  EXPECT_EQ(read("1 2 3\n4 5 6\n", "a.xyz").z_positive, ZPositive::Unknown);
}

TEST(TextPicks, namesTheLineOfAnUnreadableRow) {
  EXPECT_THAT(failure("# head\n1 2 3\n4 5 6\noops here now\n7 8 9\n"), HasSubstr("picks.xyz:4: "));
  EXPECT_THAT(failure("1 2 3\n4 5\n7 8 9\n"), HasSubstr("picks.xyz:2: "));
  EXPECT_THAT(failure("1 2 3\n4 5 6x\n7 8 9\n"), HasSubstr("picks.xyz:2: "));
  EXPECT_THAT(failure("1 2\n3 4\n"), HasSubstr("without x, y and z"));
  EXPECT_THAT(failure("1 2 oops\n3 4 5\n"), HasSubstr("picks.xyz:1: "));
  EXPECT_THAT(failure("1,2 3\n4,5,6\n"), HasSubstr("picks.xyz:1: "));
}

TEST(TextPicks, namesTheLineInALargeFileWhateverTheThreads) {
  std::string text;
  for (int i = 0; i < 200000; ++i)
    text += "1000.5 2000.5 300.25\n";
  const TempFolder folder;
  const std::string good = folder.write("good.xyz", text);
  ReadOptions one;
  one.threads = 1;
  ReadOptions four;
  four.threads = 4;
  EXPECT_EQ(readPicks(good, one).points, readPicks(good, four).points);
  EXPECT_EQ(readPicks(good, four).points.size(), 200000U);
  text.insert(21 * 150000, "broken row here\n");
  EXPECT_THAT(failure(text), HasSubstr("picks.xyz:150001: "));
}

TEST(TextPicks, tellsOfAFewUnreadableRowsAtTheEnd) {
  const PickSet picks = read("1.5 2.5 3.5\n4 5 6\n7 8 9\nEOD\n12 1");
  EXPECT_EQ(picks.points, three);
  EXPECT_EQ(picks.rejected_rows, 2U);
  EXPECT_THAT(picks.notes, Contains(HasSubstr("first in line 4")));
}

TEST(TextPicks, readsOneDecimalCommaBesideSemicolons) {
  EXPECT_EQ(read("X;Y;Z\n461000;5931000;1850,5\n461050;5931000;1850\n461050;5931050;1851,25\n").points,
            (Points{{461000, 5931000, 1850.5}, {461050, 5931000, 1850}, {461050, 5931050, 1851.25}}));
}

TEST(TextPicks, saysThatThousandsSeparatorsAreNotRead) {
  EXPECT_THAT(failure("461.000,25;5.931.000,50;1.850,50\n"), HasSubstr("thousands separators (461.000,25)"));
  EXPECT_THAT(failure("X,Y,Z\n\"461,000.25\",\"5,931,000.50\",\"1,850.50\"\n"), HasSubstr("thousands separators (461,000.25)"));
}

TEST(TextPicks, dropsWhatFortranCouldNotWrite) {
  const PickSet picks = read("1 2 3\n4 5 *******\n7 9 9\n");
  EXPECT_EQ(picks.points.size(), 2U);
  EXPECT_EQ(picks.no_data_rows, 1U);
}

TEST(TextPicks, readsDecimalCommasWhereTheyCanBeNothingElse) {
  EXPECT_EQ(read("1,5 2,5 3,5\n4 5,0 6,0\n7 8,0 9,0\n").points, three);
  EXPECT_EQ(read("x;y;z\n1,5;2,5;3,5\n4,0;5;6,0\n7,0;8,0;9\n").points, three);
  EXPECT_EQ(read("1,5\t2,5\t3,5\n4\t5,0\t6,0\n7\t8,0\t9,0\n").points, three);
  EXPECT_THAT(failure("1,5 2,5 3.5\n4,5 5,5 6.5\n"), HasSubstr("decimal commas"));
}

TEST(TextPicks, refusesWhatIsNoCloud) {
  EXPECT_THAT(failure("Dear reader,\nthis is prose.\n"), HasSubstr("is no point cloud"));
  EXPECT_THAT(failure("x y z\n"), HasSubstr("is no point cloud"));
  EXPECT_THAT(failure("nan nan nan\n1 2 1e30\n"), HasSubstr("no row holds data"));
  EXPECT_THAT(failure(" \n\r\n"), HasSubstr("is empty"));
  EXPECT_THAT(failure("solid s\nendsolid\n"), HasSubstr("is an STL mesh"));
}

TEST(TextPicks, reportsProgressToTheEnd) {
  const TempFolder folder;
  ReadOptions options;
  double last = -1.0;
  options.progress = [&](const Progress& p) {
    EXPECT_EQ(p.stage, "reading p.xyz");
    EXPECT_GE(p.fraction, last);
    last = p.fraction;
  };
  readPicks(folder.write("p.xyz", "1 2 3\n"), options);
  EXPECT_EQ(last, 1.0);
}

} // namespace
} // namespace graben
