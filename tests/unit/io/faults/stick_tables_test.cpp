// Fault sticks as tables: which column tells what, several faults in a file, files cut mid-way.
#include "stick_samples.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>
#include <functional>

namespace graben {
namespace {

using test::faultFailure;
using test::readFaultText;
using testing::Contains;
using testing::HasSubstr;
using testing::SizeIs;

const std::vector<FaultStick>& sticksOf(const FaultInput& fault) {
  return std::get<std::vector<FaultStick>>(fault.geometry);
}

constexpr int sticks = 5, nodes = 4;

Vector3 node(int s, int n) {
  return {461000.25 + 40.0 * n + 3.0 * s, 5931000.5 + 200.0 * s, -1700.5 - 150.0 * n};
}

/// Rows of the fault as \a row writes them.
std::string rows(const std::function<std::string(int stick, int node, const std::string& x, const std::string& y, const std::string& z)>& row,
                 const std::string& before_stick = "") {
  const auto number = [](double value) { return test::numberText(value, 2); };
  std::string text;
  for (int s = 0; s < sticks; ++s) {
    text += before_stick;
    for (int n = 0; n < nodes; ++n) {
      const Vector3 p = node(s, n);
      text += row(s + 1, n + 1, number(p.x()), number(p.y()), number(p.z())) + "\n";
    }
  }
  return text;
}

void expectFault(const FaultInput& fault, const std::string& name) {
  SCOPED_TRACE(name);
  ASSERT_EQ(sticksOf(fault).size(), static_cast<std::size_t>(sticks));
  for (int s = 0; s < sticks; ++s) {
    const Points& points = sticksOf(fault)[static_cast<std::size_t>(s)].points;
    ASSERT_EQ(points.size(), static_cast<std::size_t>(nodes));
    for (int n = 0; n < nodes; ++n)
      EXPECT_LT((points[static_cast<std::size_t>(n)] - node(s, n)).norm(), 1e-2);
  }
}

using S = std::string;

S of(int number) {
  return std::to_string(number);
}

TEST(StickTables, AreReadAsProgramsWriteThem) {
  const std::pair<const char*, std::string> files[] = {
      {"x y z name part stick", rows([](int s, int, S x, S y, S z) { return "   " + x + " " + y + "  " + z + " F1 1 " + of(s) + " "; })},
      {"Kingdom: line trace x y z name stick line", rows([](int s, int n, S x, S y, S z) {
         return of(700 + s) + " " + of(600 + 7 * n) + " " + x + " " + y + " " + z + " F1 " + of(s) + " " + of(700 + s);
       })},
      {"x y z stick node", rows([](int s, int n, S x, S y, S z) { return x + "\t" + y + "\t" + z + "\t" + of(s) + "\t" + of(n); })},
      {"x y z stick node from 0", rows([](int s, int n, S x, S y, S z) { return x + " " + y + " " + z + " " + of(s - 1) + " " + of(n - 1); })},
      {"x y z node", rows([](int, int n, S x, S y, S z) { return x + " " + y + " " + z + " " + of(n); })},
      {"x y z and flags of begin, middle and end",
       rows([](int, int n, S x, S y, S z) { return x + " " + y + " " + z + " " + of(n == 1 ? 1 : n == nodes ? 3 : 2); })},
      {"Charisma sticks on crosslines",
       rows([](int s, int n, S x, S y, S z) { return "XLINE- " + of(600 + s) + " " + of(700 + n) + " " + x + " " + y + " " + z + " F1 " + of(s); })},
      {"a survey's line and trace beside the sticks", S("Line,Trace,X,Y,Z,Segment\n") + rows([](int s, int n, S x, S y, S z) {
         return of(700) + "," + of(600 + 7 * n) + "," + x + "," + y + "," + z + "," + of(s);
       })},
      {"x y z stick", rows([](int s, int, S x, S y, S z) { return x + " " + y + " " + z + " " + of(10 * s); })},
      {"stick x y z", rows([](int s, int, S x, S y, S z) { return of(s) + " " + x + " " + y + " " + z; })},
      {"a header", S("# \"X\"\t\"Y\"\t\"Z\"\t\"StickNr\"\t\"NodeNr\"\n") +
                       rows([](int s, int n, S x, S y, S z) { return x + "\t" + y + "\t" + z + "\t" + of(s) + "\t" + of(n); })},
      {"names in a header, other order",
       S("Stick,Fault,Z,X,Y\n") + rows([](int s, int, S x, S y, S z) { return of(s) + ",F1," + z + "," + x + "," + y; })},
      {"GMT", S("# @VGMT1.0\n") + rows([](int, int, S x, S y, S z) { return x + " " + y + " " + z; }, "> -L\"stick\"\n")},
      {"POLY_ID", S("X_UTME,Y_UTMN,Z_TVDSS,POLY_ID\n") + rows([](int s, int, S x, S y, S z) { return x + "," + y + "," + z + "," + of(s); })},
      {"Z-MAP+", S("!\n! exported\n!\n@FREE POINT, DATA, 80, 1\nX (EASTING), 1, 1, 1, 20, 7, , ,\nY (NORTHING), 2, 2, 1, 20, 7, , ,\nZ VALUE, 3, 3, "
                   "1, 20, 7, , ,\n"
                   "SEG I.D., 4, 4, 1, 10, 0, , ,\n@\n") +
                     rows([](int s, int, S x, S y, S z) { return x + " " + y + " " + z + " " + of(s); })},
      {"DUG", rows([](int, int, S x, S y, S z) { return x + " " + y + " " + z; }, "\n")},
      {"a leading number, ends", rows([](int s, int n, S x, S y, S z) { return of(4 * s + n) + " " + x + " " + y + " " + z; }, "999 999 999 999\n")},
      {"BLN", rows([](int, int, S x, S y, S z) { return x + "," + y + "," + z; }, "4,1,F1\n")},
      {"IESX", "PROFILE F1  TYPE 1  3 a_fault.ifdf m ms\nSNAPPING PARAMETERS 5 0 1\n" +
                   rows([](int s, int, S x, S y, S z) { return x + " " + y + " " + of(s) + " 14 " + z; }) + "EOD\n"},
      {"decimal commas", rows([](int s, int, S x, S y, S z) {
         S row = x + ";" + y + ";" + z + ";" + of(s);
         std::replace(row.begin(), row.end(), '.', ',');
         return row;
       })}};
  for (const auto& [name, text] : files) {
    const auto faults = readFaultText(text);
    ASSERT_THAT(faults, SizeIs(1)) << name;
    expectFault(faults[0], name);
  }
}

TEST(StickTables, SayWhichColumnsTheyTook) {
  const auto faults = readFaultText(rows([](int s, int n, S x, S y, S z) { return x + " " + y + " " + z + " " + of(s) + " " + of(n); }));
  EXPECT_THAT(faults[0].notes, Contains(HasSubstr("columns 1, 2, 3 of 5 taken as x, y, z, 4 as stick, 5 as node")));
}

TEST(StickTables, HoldSeveralFaultsByName) {
  const auto named = [](const S& name) {
    return rows([name](int s, int, S x, S y, S z) { return x + "," + y + "," + z + "," + name + "," + of(s); });
  };
  const auto faults = readFaultText("X,Y,Z,name,stick\n" + named("North") + named("\"South, lower\"") + named("North 2"), "f.csv");
  ASSERT_THAT(faults, SizeIs(3));
  EXPECT_EQ(faults[0].name, "North");
  EXPECT_EQ(faults[1].name, "South, lower");
  for (const FaultInput& fault : faults)
    expectFault(fault, fault.name);
  const auto opendtect = readFaultText(rows([](int s, int n, S x, S y, S z) { return "\"F1\"\t" + x + "\t" + y + "\t" + z + "\t" + of(s) + "\t" + of(n); }) +
                              rows([](int s, int n, S x, S y, S z) { return "\"F2\"\t" + x + "\t" + y + "\t" + z + "\t" + of(s) + "\t" + of(n); }));
  ASSERT_THAT(opendtect, SizeIs(2));
  EXPECT_EQ(opendtect[1].name, "F2");
  expectFault(opendtect[1], "F2");
}

TEST(StickTables, NodesOutOfOrderAndSticksMixedAreSorted) {
  std::string text = "X Y Z stick node\n";
  for (int n = nodes; n-- > 0;)
    for (int s = 0; s < sticks; ++s) {
      char row[120];
      std::snprintf(row, sizeof row, "%.2f %.2f %.2f %d %d\n", node(s, n).x(), node(s, n).y(), node(s, n).z(), s, n);
      text += row;
    }
  expectFault(readFaultText(text)[0], "mixed");
}

TEST(StickTables, HeaderNamesTellTheDirectionOfZ) {
  const std::string body = "1,2,300,1\n3,4,500,1\n5,6,300,2\n7,8,500,2\n";
  EXPECT_EQ(readFaultText("X,Y,Depth,stick\n" + body)[0].z_positive, ZPositive::Down);
  EXPECT_EQ(readFaultText("X,Y,Z,stick\n" + body)[0].z_positive, ZPositive::Unknown);
  EXPECT_EQ(readFaultText("X,Y,Elevation,stick\n" + body)[0].z_positive, ZPositive::Up);
}

TEST(StickTables, DoNotGuess) {
  const std::string four = rows([](int s, int n, S x, S y, S z) { return x + " " + y + " 0." + of((7 * s + n * n) % 10) + " " + z; });
  EXPECT_THAT(faultFailure(four), HasSubstr("columns of the sticks are not certain"));
  EXPECT_THAT(faultFailure("X,Y,stick\n1,2,1\n3,4,1\n"), HasSubstr("no z"));
  EXPECT_THAT(faultFailure("a 1 2 3\nb 1 2 c\nb 1 2 c\nb 4 5 c\nb 4 5 c\n"), HasSubstr("fewer than three columns hold numbers"));
}

TEST(StickTables, LinesWithTracesAreAHorizons) {
  EXPECT_THAT(faultFailure("Line,Trace,X,Y,Time\nL1,1,0,0,1.5\nL1,2,1,0,1.5\nL2,1,0,1,1.5\nL2,2,1,1,1.5\n"),
              HasSubstr("as that of a horizon along lines does"));
}

TEST(StickTables, CutFilesAreSaid) {
  const std::string whole = "1.5 2.5 3.5\n4 5 6\n999 999 999\n7 8 9\n1.5 2.5 7.25\n";
  EXPECT_TRUE(readFaultText(whole, "f.pol")[0].warnings.empty());
  EXPECT_THAT(readFaultText(whole.substr(0, whole.size() - 3), "f.pol")[0].warnings, Contains(HasSubstr("may be cut short")));
  EXPECT_THAT(faultFailure(whole.substr(0, whole.size() - 6), "f.pol"), HasSubstr("f.pol:5: "));
  const std::string gocad = "GOCAD TSurf 1\nTFACE\nVRTX 1 0 0 0\nVRTX 2 1 0 0\nVRTX 3 0 1 0\nTRGL 1 2 3\n";
  EXPECT_TRUE(readFaultText(gocad + "END", "f.ts")[0].warnings.empty());
  EXPECT_THAT(readFaultText(gocad, "f.ts")[0].warnings, Contains(HasSubstr("has no END")));
  EXPECT_THAT(faultFailure("4,1\n1,2,3\n4,5,6\n7,8,9\n"), HasSubstr("the file is cut short"));
}

TEST(StickTables, ManyNodesAreReadFast) {
  std::string text;
  for (int s = 0; s < 3; ++s)
    for (int n = 0; n < 35000; ++n)
      text += "461000.5 " + of(5931000 + 1800 * s) + ".5 " + std::to_string(-1700.0 - 0.02 * n) + " " + of(s) + " " + of(n) + "\n";
  const auto start = std::chrono::steady_clock::now();
  const auto faults = readFaultText(text);
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 5.0);
  ASSERT_EQ(sticksOf(faults[0]).size(), 3U);
  EXPECT_EQ(sticksOf(faults[0])[2].points.size(), 35000U);
}

} // namespace
} // namespace graben
