// Grids read as picks on their nodes, whichever way their values run.
#include "pick_samples.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstring>

namespace graben {
namespace {

using test::readFailure;
using test::readText;
using testing::Contains;
using testing::HasSubstr;

constexpr int nx = 4, ny = 3;
constexpr double x0 = 461000.0, y0 = 5931000.0, dx = 25.0, dy = 50.0;

double zAt(int i, int j) {
  return -2000.0 - 7.0 * i - 31.0 * j;
}

bool isVoid(int i, int j) {
  return i == 2 && j == 1;
}

std::string value(int i, int j, const std::string& null) {
  return (isVoid(i, j) ? null : std::to_string(zAt(i, j))) + " ";
}

std::string byRows(const std::string& null, bool from_north = false) {
  std::string text;
  for (int j = 0; j < ny; ++j, text += "\n")
    for (int i = 0; i < nx; ++i)
      text += value(i, from_north ? ny - 1 - j : j, null);
  return text;
}

std::string byColumns(const std::string& null) {
  std::string text;
  for (int i = 0; i < nx; ++i, text += "\n")
    for (int j = ny; j-- > 0;)
      text += value(i, j, null);
  return text;
}

void expectNodes(const PickSet& picks, const std::string& kind) {
  SCOPED_TRACE(kind);
  EXPECT_THAT(picks.notes, Contains(HasSubstr("is a grid (" + kind + ", 4 x 3 nodes, 25 x 50 apart)")));
  EXPECT_EQ(picks.no_data_rows, 1U);
  ASSERT_EQ(picks.points.size(), 11U);
  for (int i = 0; i < nx; ++i)
    for (int j = 0; j < ny; ++j) {
      const Vector3 node(x0 + dx * i, y0 + dy * j, zAt(i, j));
      const bool found = std::any_of(picks.points.begin(), picks.points.end(), [&](const Vector3& p) { return (p - node).norm() < 1e-3; });
      EXPECT_NE(found, isVoid(i, j)) << i << " " << j;
    }
}

const std::string irap_head = "-996 3 25.0 50.0\n461000.0 461075.0 5931000.0 5931100.0\n4 0.0 461000.0 5931000.0\n0 0 0 0 0 0 0\n";
const std::string gxf_head = "#TITLE\na surface\n#POINTS\n4\n#ROWS\n3\n#PTSEPARATION\n25\n#RWSEPARATION\n50\n#XORIGIN\n461000\n#YORIGIN\n5931000\n"
                             "#ROTATION\n0\n#DUMMY\n-1e12\n";

TEST(GridPicks, ReadsTextGrids) {
  expectNodes(readText(irap_head + byRows("9999900.000000")), "IRAP classic");
  expectNodes(readText("! grid\n! of a horizon\n@GRID FILE, GRID, 5\n15, 1E+30, , 4, 1\n3, 4, 461000, 461075, 5931000, 5931100\n0.0, 0.0, 0.0\n@\n" +
                       byColumns("0.1000000E+31")),
              "Z-MAP+");
  expectNodes(readText(gxf_head + "#GRID\n" + byRows("-1e12")), "GXF");
  expectNodes(readText(gxf_head + "#SENSE\n-2\n#GRID\n" + byRows("-1e12", true)), "GXF");
  expectNodes(
      readText("FSASCI 0 1 COMPUTED 0 0.1E+31\nFSATTR 0 0\nFSLIMI 461000 461075 5931000 5931100 -2100 -2000\nFSNROW 3 4\nFSXINC 25 50\n->Top\n" +
               byColumns("1e30")),
      "CPS-3");
  expectNodes(readText("DSAA\n4 3\n461000 461075\n5931000 5931100\n-2100 -2000\n" + byRows("1.70141e+38")), "Surfer");
  expectNodes(readText("ncols 4\nnrows 3\nxllcenter 461000\nyllcenter 5931000\ndx 25\ndy 50\nNODATA_value -9999\n" + byRows("-9999", true)), "ESRI");
}

TEST(GridPicks, ReadsValuesThatTouch) {
  std::string text = "@G, GRID, 3\n10, -9999.00, , 2, 1\n3, 4, 461000, 461075, 5931000, 5931100\n0, 0, 0\n@\n";
  for (int i = 0; i < nx; ++i, text += "\n")
    for (int j = ny; j-- > 0;) {
      char word[16];
      std::snprintf(word, sizeof word, "%10.4f", isVoid(i, j) ? -9999.0 : zAt(i, j));
      text += word;
    }
  EXPECT_NE(text.find("-2062.0000-2031.0000-2000.0000"), std::string::npos);
  expectNodes(readText(text), "Z-MAP+");
}

TEST(GridPicks, TurnsThem) {
  const PickSet picks = readText("-996 2 10 20\n100 110 200 220\n2 90 100 200\n0 0 0 0 0 0 0\n1 2 3 4\n");
  ASSERT_EQ(picks.points.size(), 4U);
  EXPECT_LT((picks.points[1] - Vector3(100, 210, 2)).norm(), 1e-9);
  EXPECT_LT((picks.points[2] - Vector3(80, 200, 3)).norm(), 1e-9);
}

template <typename Number>
void append(std::string& bytes, Number number) {
  char copy[sizeof number];
  std::memcpy(copy, &number, sizeof number);
  bytes.append(copy, sizeof number);
}

TEST(GridPicks, ReadsSurfersBinaryGrids) {
  std::string six = "DSBB";
  append(six, std::int16_t{nx});
  append(six, std::int16_t{ny});
  for (const double limit : {461000.0, 461075.0, 5931000.0, 5931100.0, -2100.0, -2000.0})
    append(six, limit);
  std::string seven = "DSRB";
  append(seven, std::uint32_t{4});
  append(seven, std::uint32_t{1});
  seven += "GRID";
  append(seven, std::uint32_t{72});
  append(seven, std::int32_t{ny});
  append(seven, std::int32_t{nx});
  for (const double entry : {x0, y0, dx, dy, -2100.0, -2000.0, 0.0, 1.70141e38})
    append(seven, entry);
  seven += "DATA";
  append(seven, std::uint32_t{8 * nx * ny});
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      append(six, static_cast<float>(isVoid(i, j) ? 1.70141e38 : zAt(i, j)));
      append(seven, isVoid(i, j) ? 1.70141e38 : zAt(i, j));
    }
  expectNodes(readText(six, "a.grd"), "Surfer 6");
  expectNodes(readText(seven, "a.grd"), "Surfer 7");
  for (std::size_t cut = 1; cut < seven.size(); cut += 5)
    EXPECT_NE(readFailure(seven.substr(0, cut), "a.grd"), "") << cut;
}

TEST(GridPicks, RefusesWhatLiesAboutItsSize) {
  EXPECT_THAT(readFailure(irap_head + "1 2 3\n"), HasSubstr("holds 3 values instead of 12: the file is cut short"));
  EXPECT_THAT(readFailure(irap_head + byRows("0") + "7\n"), HasSubstr("13 values instead of 12"));
  EXPECT_THAT(readFailure("-996 1e8 25.0 50.0\n0 1 0 1\n100000000 0 0 0\n0 0 0 0 0 0 0\n1 2\n"), HasSubstr("instead of"));
  EXPECT_THAT(readFailure("-996 0 25.0 50.0\n0 1 0 1\n4 0 0 0\n0 0 0 0 0 0 0\n"), HasSubstr("impossible size"));
  EXPECT_THAT(readFailure("-996 3 25.0\n"), HasSubstr("cut short"));
  EXPECT_THAT(readFailure(irap_head + "1 2 three\n"), HasSubstr("no value of a grid"));
  EXPECT_THAT(readFailure(gxf_head + "#GTYPE\n2\n#GRID\n!!\n"), HasSubstr("compressed"));
}

} // namespace
} // namespace graben
