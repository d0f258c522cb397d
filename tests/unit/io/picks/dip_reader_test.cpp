#include "graben/io/dip_reader.h"

#include "graben/core/errors.h"
#include "support/temp_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace graben {
namespace {

using test::TempFolder;
using testing::Contains;
using testing::HasSubstr;

DipSet read(const std::string& content, const std::string& name = "dips.txt") {
  const TempFolder folder;
  return readDips(folder.write(name, content));
}

std::string failure(const std::string& content, const std::string& name = "dips.txt") {
  try {
    read(content, name);
  } catch (const ParseError& error) {
    return error.what();
  }
  return {};
}

/// Each row of the file as x y z dip azimuth.
void expectDips(const DipSet& set, const std::vector<std::array<double, 5>>& expected) {
  ASSERT_EQ(set.dips.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const auto& row = expected[i];
    EXPECT_EQ(set.dips[i].place, Vector3(row[0], row[1], row[2]));
    EXPECT_EQ(set.dips[i].normal, normalOf(DipAzimuth{row[3], row[4]}));
  }
}

const std::vector<std::array<double, 5>> two = {{100, 200, -1500.5, 12, 45}, {300, 400, -1600, 8.5, 271}};

TEST(DipReader, WithoutNamesTheColumnsAreDipAndAzimuth) {
  const DipSet set = read("100 200 -1500.5 12 45\n300 400 -1600 8.5 271\n");
  expectDips(set, two);
  EXPECT_THAT(set.notes, Contains(HasSubstr("taken as x, y, z, dip, azimuth")));
  expectDips(read("# measured in outcrop\n100,200,-1500.5,12,45\r\n300,400,-1600,8.5,271\r\n", "dips.csv"), two);
}

TEST(DipReader, findsColumnsByTheNamesUsersWrite) {
  for (const std::string azimuth : {"azimuth", "Dip_Direction", "DIPDIR", "dip azimuth", "Dip Dir (deg)"})
    for (const std::string dip : {"dip", "Inclination", "DIP [deg]"})
      expectDips(read("id,X,Y,Depth," + azimuth + "," + dip + "\n1,100,200,-1500.5,45,12\n2,300,400,-1600,271,8.5\n", "a.csv"), two);
  expectDips(read("# x y z dip azimuth\n100 200 -1500.5 12 45\n300 400 -1600 8.5 271\n"), two);
}

TEST(DipReader, strikeFollowsTheRightHandRule) {
  expectDips(read("x y z strike dip\n100 200 -1500.5 315 12\n300 400 -1600 181 8.5\n"), two);
  expectDips(read("x y z strike dip\n100 200 -1500.5 -45 12\n300 400 -1600 -179 8.5\n"), two);
  expectDips(read("x y z strike dip azimuth\n100 200 -1500.5 1 12 45\n300 400 -1600 2 8.5 271\n"), two);
}

TEST(DipReader, azimuthMayBeNegative) {
  expectDips(read("100 200 -1500.5 12 45\n300 400 -1600 8.5 -89\n"), two);
}

TEST(DipReader, anglesMeanTheSameWhereZIsDepth) {
  const DipSet set = read("x,y,depth,dip,azimuth\n0,0,1500,30,90\n");
  EXPECT_EQ(set.dips[0].place.z(), 1500.0);
  EXPECT_GT(set.dips[0].normal.z(), 0.0);
  EXPECT_NEAR(set.dips[0].normal.x(), 0.5, 1e-15);
}

TEST(DipReader, dropsRowsWithoutDataWithACount) {
  const DipSet set = read("100 200 -1500.5 12 45\n1 1 1 nan 5\n1 1 1 5 -999.25\n1 1 1e30 5 5\n1 1 1 -999 -999\n300 400 -1600 8.5 271\n");
  expectDips(set, two);
  EXPECT_EQ(set.no_data_rows, 4U);
  EXPECT_THAT(set.notes, Contains(HasSubstr("4 rows without data")));
  EXPECT_THAT(failure("1 1 1 nan 5\n"), HasSubstr("no row holds data"));
}

TEST(DipReader, namesTheLineOfABadRow) {
  EXPECT_THAT(failure("1 2 3 4 5\n1 2 3 91 5\n1 2 3 4 5\n"), HasSubstr("dips.txt:2: dip 91 is not within 0 to 90"));
  EXPECT_THAT(failure("# c\n\n1 2 3 4 5\n1 2 3 4 360.5\n"), HasSubstr("dips.txt:4: azimuth 360.5 is not within"));
  EXPECT_THAT(failure("x y z strike dip\n1 2 3 -181 5\n"), HasSubstr("dips.txt:2: strike -181 is not within"));
  EXPECT_THAT(failure("1 2 3 4 5\n1 2 3 N30E 5\n1 2 3 4 5\n"), HasSubstr("dips.txt:2: this row is no dip measurement"));
  EXPECT_THAT(failure("1 2 3 4\n"), HasSubstr("dips.txt:1: a row of numbers without x, y, z, dip and azimuth"));
}

TEST(DipReader, namesTheColumnTheHeaderLacks) {
  EXPECT_THAT(failure("x y z azimuth quality\n1 2 3 4 5\n"), HasSubstr("none for the dip"));
  EXPECT_THAT(failure("x y z dip quality\n1 2 3 4 5\n"), HasSubstr("none for azimuth"));
  EXPECT_THAT(failure("x y dip azimuth quality\n1 2 3 4 5\n"), HasSubstr("none for z"));
}

TEST(DipReader, refusesWhatHoldsNoDips) {
  EXPECT_THAT(failure(""), HasSubstr("the file is empty"));
  EXPECT_THAT(failure(" \r\n"), HasSubstr("the file is empty"));
  EXPECT_THAT(failure("no numbers here\n"), HasSubstr("is no table of dips"));
  EXPECT_THAT(failure("ply\nformat ascii 1.0\n"), HasSubstr("is a PLY file, not a table of dips"));
  EXPECT_THROW(readDips("no-such-file.txt"), IoError);
}

} // namespace
} // namespace graben
