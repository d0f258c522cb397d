// Which columns of a table are taken for x, y and z, and which table is not guessed at.
#include "number_text.h"
#include "pick_samples.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

namespace graben {
namespace {

using test::readFailure;
using test::readText;
using test::SurveyNode;
using test::surveyNodes;
using testing::Contains;
using testing::HasSubstr;

std::string number(double value) { return test::numberText(value, 3); }

/// A table of the survey: letters i j x y z n (row number), a (an attribute), f (the constants 1 14), w (z in whole numbers) or others as they are.
std::string table(const std::string& columns, const std::string& separator = " ") {
  std::string text;
  for (const SurveyNode& node : surveyNodes()) {
    for (std::size_t c = 0; c < columns.size(); ++c) {
      text += c == 0 ? "" : separator;
      switch (columns[c]) {
      case 'i': text += std::to_string(node.inline_number); break;
      case 'j': text += std::to_string(node.crossline); break;
      case 'n': text += std::to_string(node.number); break;
      case 'x': text += number(node.x); break;
      case 'y': text += number(node.y); break;
      case 'z': text += number(node.z); break;
      case 'w': text += std::to_string(static_cast<int>(node.z)); break;
      case 'a': text += number(0.1 * (node.number % 7)); break;
      case 'f': text += "1" + separator + "14"; break;
      case 't': text += "P" + std::to_string(node.number); break;
      default: text += columns[c];
      }
    }
    text += '\n';
  }
  return text;
}

void expectSurvey(const PickSet& picks) {
  const auto nodes = surveyNodes();
  ASSERT_EQ(picks.points.size(), nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i)
    EXPECT_LT((picks.points[i] - Vector3(nodes[i].x, nodes[i].y, nodes[i].z)).norm(), 2e-3) << i;
}

TEST(PickColumns, LineNumbersAndRowNumbersAreNoCoordinates) {
  for (const char* columns : {"xyz", "ijxyz", "xyijz", "xyzij", "xyijza", "nxyz", "xyzn", "nijxyz", "xyza", "txyz", "tijxyz"})
    for (const char* separator : {" ", "\t", ",", ";"})
      expectSurvey(readText(table(columns, separator)));
}

TEST(PickColumns, SaysWhatItTook) {
  const PickSet picks = readText(table("ijxyz"));
  EXPECT_THAT(picks.notes, Contains(HasSubstr("columns 1, 2 taken for inline and crossline")));
  EXPECT_THAT(picks.notes, Contains(HasSubstr("columns 3, 4, 5 of 5 taken as x, y, z")));
  EXPECT_THAT(picks.layout, HasSubstr("5 columns parted by blanks"));
}

TEST(PickColumns, DoesNotGuess) {
  for (const char* columns : {"xyfz", "xywa", "fxyz", "wxyz", "xywz"})
    EXPECT_THAT(readFailure(table(columns)), HasSubstr("--columns X,Y,Z")) << columns;
  // Shot points along lines that are not straight: nothing tells them from whole coordinates.
  std::string lines;
  for (int i = 0; i < 60; ++i)
    lines += std::to_string(100 + i / 20) + " " + std::to_string(i % 20 * 7) + " " + number(461000.1 + 40.0 * i) + " " +
             number(5931000.1 + 13.0 * i * i) + " -2000.5\n";
  EXPECT_THAT(readFailure(lines), HasSubstr("--columns X,Y,Z"));
}

TEST(PickColumns, AreTakenAsAsked) {
  ReadOptions options;
  options.columns = {"1", "2", "5"};
  expectSurvey(readText(table("xyfz"), "a.dat", options));
  options.columns = {"East", "north", "TWT"};
  const PickSet named = readText("East North Pick TWT [ms]\n" + table("xyaz"), "a.dat", options);
  EXPECT_EQ(named.points.size(), surveyNodes().size());
  options.columns = {"3", "2", "4"};
  EXPECT_EQ(readText("9 2 1 3\n9 5 4 6\n", "a.dat", options).points, (Points{{1, 2, 3}, {4, 5, 6}}));
  options.columns = {"1", "2", "Depth"};
  EXPECT_THAT(readFailure("X,Y,Z\n1,2,3\n", "a.csv", options), HasSubstr("has no column 'Depth'"));
  options.columns = {"1", "2", "4"};
  EXPECT_THAT(readFailure("1 2 3\n4 5 6\n", "a.dat", options), HasSubstr("a row has 3 columns"));
}

TEST(PickColumns, LinesWithoutPlacesAndDegreesAreRefused) {
  EXPECT_THAT(readFailure("Inline,Crossline,Z\n" + table("ijz", ",")), HasSubstr("inline and crossline, but no x and y"));
  EXPECT_THAT(readFailure("lon,lat,z\n2.5,53.5,-2000\n2.6,53.6,-2001\n"), HasSubstr("longitude and latitude"));
  EXPECT_THAT(readText(table("ijz")).warnings, Contains(HasSubstr("inline and crossline")));
}

TEST(PickColumns, ReadsPetrelPointsWithAttributes) {
  const std::string head = "# Points with attributes\n# Unit in X and Y direction: m\n# Unit in depth: ft\nVERSION 1\nBEGIN HEADER\nX\nY\nZ\n"
                           "FLOAT,Amp\nSTRING,Name\nEND HEADER\n";
  const PickSet picks = readText(head + "1.5 2.5 3.5 1.0 \"A b\"\n4 5 6 1.0 \"A b\"\n");
  EXPECT_EQ(picks.points, (Points{{1.5, 2.5, 3.5}, {4, 5, 6}}));
  EXPECT_EQ(picks.xy_unit, "m");
  EXPECT_EQ(picks.z_unit, "ft");
}

TEST(PickColumns, ReadsRmsPointAttributes) {
  const PickSet picks = readText("Discrete FaultBlock\nFloat conf\nString Well\n1.5 2.5 3.5 1 0.5 A-1\n4 5 6 2 0.5 UNDEF\n");
  EXPECT_EQ(picks.points, (Points{{1.5, 2.5, 3.5}, {4, 5, 6}}));
}

TEST(PickColumns, NamesTellTheDirectionAndUnitOfZ) {
  struct Case {
    const char* header;
    const char* z;
    ZPositive way;
    const char* unit;
  };
  for (const Case& c : {Case{"X,Y,Depth", "2000", ZPositive::Down, ""}, Case{"X,Y,TWT_ms", "2000", ZPositive::Down, "ms"},
                        Case{"X_m,Y_m,TVDSS_ft", "2000", ZPositive::Down, "ft"}, Case{"X,Y,Elevation", "-2000", ZPositive::Up, ""},
                        Case{"X,Y,Depth (m)", "-2000", ZPositive::Up, "m"}, Case{"X,Y,Z", "2000", ZPositive::Unknown, ""},
                        Case{"X,Y,Z [s]", "-2", ZPositive::Unknown, "s"}}) {
    const PickSet picks = readText(std::string(c.header) + "\n1,2," + c.z + "\n3,4," + c.z + "\n", "a.csv");
    EXPECT_EQ(picks.z_positive, c.way) << c.header;
    EXPECT_EQ(picks.z_unit, c.unit) << c.header;
    EXPECT_EQ(picks.z_reason.empty(), c.way == ZPositive::Unknown) << c.header;
  }
}

TEST(PickColumns, NamesOfZAreMadeOfWords) {
  const PickSet picks = readText("X (m),Y (m),Depth TVDSS (ft)\n0,0,100\n50,0,110\n0,50,130\n", "p.csv");
  EXPECT_EQ(picks.z_unit, "ft");
  EXPECT_EQ(picks.z_positive, ZPositive::Down);
  const PickSet other = readText("Y,X,Top A\n7,0,100\n7,50,110\n9,0,130\n", "p.csv");
  EXPECT_THAT(other.notes, Contains(HasSubstr("column 3, 'Top A', taken as z")));
  EXPECT_EQ(other.points[1], Vector3(50, 7, 110));
}

TEST(PickColumns, ANameGivenTwiceIsRefused) {
  EXPECT_THAT(readFailure("X,X,Y,Z\n0,0,1,100\n50,0,2,110\n"), HasSubstr("picks.dat:1: the header names two columns 'X'"));
  ReadOptions options;
  options.columns = {"2", "3", "4"};
  EXPECT_EQ(readText("X,X,Y,Z\n0,0,1,100\n50,0,2,110\n", "p.csv", options).points[1], Vector3(0, 2, 110));
}

TEST(PickColumns, ANameBeforeEachRowIsReadFast) {
  std::string text;
  for (int i = 0; i < 20000; ++i)
    text += "Point " + std::to_string(i) + " of some\n"; // rows that are none
  EXPECT_THAT(readFailure(text), HasSubstr("is no point cloud"));
  text.clear();
  for (int i = 0; i < 900; ++i)
    text += "P" + std::to_string(i) + " " + std::to_string(i % 30) + ".5 " + std::to_string(i / 30) + ".5 7.5\n";
  EXPECT_EQ(readText(text).points.size(), 900U);
}

std::string twoHorizons(const std::string& format, const std::string& header = "") {
  std::string text = header;
  for (const char* name : {"Top A", "Base"})
    for (const SurveyNode& node : surveyNodes()) {
      std::string row = format;
      const auto put = [&](const std::string& key, const std::string& value) { row.replace(row.find(key), key.size(), value); };
      put("NAME", name);
      put("XYZ", number(node.x) + "\t" + number(node.y) + "\t" + number(node.z - (name[0] == 'B' ? 300.0 : 0.0)));
      text += row + "\n";
    }
  return text;
}

TEST(Horizons, SeveralInOneFileAreRefusedAndNamed) {
  for (const std::string& text : {twoHorizons("\"NAME\"\tXYZ"), twoHorizons("NAME\tXYZ", "Horizon\tX\tY\tZ\n"), twoHorizons("XYZ\tNAME"),
                                  twoHorizons("\"NAME\"\tXYZ", "# \"X\"\t\"Y\"\t\"Z\"\n")}) {
    EXPECT_THAT(readFailure(text), HasSubstr("holds 2 horizons: Top A, Base; name one: --horizon FILE:NAME")) << text.substr(0, 60);
    ReadOptions options;
    options.horizon = "Top A";
    const PickSet top = readText(text, "h.dat", options);
    expectSurvey(top);
    EXPECT_EQ(top.horizon, "Top A");
    options.horizon = "Base";
    EXPECT_NEAR(readText(text, "h.dat", options).points.front().z(), -2300.5, 1e-3);
    options.horizon = "Bottom";
    EXPECT_THAT(readFailure(text, "h.dat", options), HasSubstr("holds no horizon 'Bottom'"));
  }
}

TEST(Horizons, AColumnCalledNameTellsThemApart) {
  std::string rows = "name,x,y,z\n";
  for (int i = 0; i < 20; ++i)
    rows += std::string(i % 2 == 0 ? "Top" : "Base") + "," + std::to_string(10 * i) + "," + std::to_string(7 * (i % 5)) + ",100\n";
  EXPECT_THAT(readFailure(rows), HasSubstr("holds 2 horizons: Top, Base"));
  ReadOptions options;
  options.horizon = "Base";
  EXPECT_EQ(readText(rows, "h.csv", options).points.size(), 10U);
}

TEST(Horizons, LabelsOfPointsAreNone) {
  EXPECT_EQ(readText("Well,X,Y,Z\nA-1,1,2,3\nA-2,4,5,6\nA-2,7,8,9\n", "w.csv").points.size(), 3U);
  ReadOptions options;
  options.horizon = "A";
  EXPECT_THAT(readFailure("1 2 3\n4 5 6\n", "h.dat", options), HasSubstr("names no horizon"));
}

TEST(Horizons, AreNamedBehindTheFile) {
  const test::TempFolder folder;
  const std::string path = folder.write("a:b.xyz", "1 2 3\n");
  EXPECT_EQ(splitPickSource(path).path, path);
  EXPECT_EQ(splitPickSource(path).horizon, "");
  EXPECT_EQ(splitPickSource("h.dat:Top A").path, "h.dat");
  EXPECT_EQ(splitPickSource("h.dat:Top A").horizon, "Top A");
  EXPECT_EQ(splitPickSource("h.dat").path, "h.dat");
}

} // namespace
} // namespace graben
