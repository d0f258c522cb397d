#include "support/tool.h"

#include <gmock/gmock.h>

namespace graben {
namespace {

using testing::HasSubstr;
using testing::Not;

class Info : public test::ToolTest {
protected:
  void SetUp() override {
    ToolTest::SetUp();
    std::string picks = "X,Y,TWT_ms\n";
    std::string horizons = "Horizon X Y Z\n";
    for (int i = 0; i < 20; ++i)
      for (int j = 0; j < 20; ++j) {
        const std::string place = std::to_string(461000 + 25 * i) + "," + std::to_string(5931000 + 25 * j) + ",";
        picks += place + (i == 3 ? "9999900" : std::to_string(1500 + i + 2 * j)) + "\n";
        for (const char* name : {"Top", "Base"})
          horizons += std::string(name) + " " + std::to_string(25 * i) + " " + std::to_string(25 * j) + " " + std::to_string(-1500 - i) + ".5\n";
      }
    write("picks.csv", picks);
    write("horizons.txt", horizons);
    write("F1.pol", "1 2 -1400\n3 2 -1600\n999 999 999\n1 100 -1400\n3 100 -1600\n999 999 999\n");
    write("f.ts", "GOCAD TSurf 1\nHEADER {\nname:F2\n}\nZPOSITIVE Depth\nTFACE\nVRTX 1 0 0 0\nVRTX 2 1 0 0\nVRTX 3 0 1 0\nTRGL 1 2 3\nEND\n");
  }
};

TEST_F(Info, SaysWhatPicksAre) {
  const test::Outcome outcome = run("info", "picks.csv");
  EXPECT_EQ(outcome.code, 0) << outcome.errors;
  for (const char* word : {"text table, 3 columns parted by ','", "picks of a horizon", "380 picks, 20 rows without data, 0 rejected",
                           "z 9999900, 20 times", "x         461000 to 461475", "z         1500 to 1557 ms",
                           "down (depth or time): the header calls z 'TWT_ms'", "spacing   25.0", "densely in all directions", "z grows down"})
    EXPECT_THAT(outcome.output, HasSubstr(word));
}

TEST_F(Info, SaysWhatFaultsAre) {
  const test::Outcome outcome = run("info", "F1.pol f.ts");
  EXPECT_EQ(outcome.code, 0) << outcome.errors;
  for (const char* word : {"F1.pol\n", "sticks of a fault: F1", "2 sticks, 4 nodes", "z grows   not said", "a surface: F2",
                           "3 vertices, 1 triangles in 1 pieces", "down (depth or time)"})
    EXPECT_THAT(outcome.output, HasSubstr(word));
}

TEST_F(Info, ListsAllHorizonsOfAFile) {
  const test::Outcome all = run("info", "horizons.txt");
  EXPECT_EQ(all.code, 0) << all.errors;
  EXPECT_THAT(all.output, HasSubstr("picks of a horizon Top"));
  EXPECT_THAT(all.output, HasSubstr("picks of a horizon Base"));
  EXPECT_THAT(run("info", "horizons.txt:Base").output, Not(HasSubstr("horizon Top")));
}

TEST_F(Info, TakesFlatLinesOfManyPointsForPicks) {
  std::string lines;
  std::string rows;
  for (int line = 0; line < 6; ++line) {
    for (int i = 0; i < 40; ++i) {
      lines += std::to_string(25 * i) + ".5 " + std::to_string(500 * line) + ".25 " + std::to_string(-2000 - i % 5) + ".125\n";
      rows += std::to_string(25 * i) + ".5 " + std::to_string(25 * line) + ".25 " + std::to_string(-2000 - 15 * i) + ".125\n"; // 31 degrees
    }
    lines += "\n";
  }
  write("lines.xyz", lines);
  write("steep.xyz", rows);
  EXPECT_THAT(run("info", "lines.xyz").output, HasSubstr("picks of a horizon"));
  EXPECT_THAT(run("info", "steep.xyz").output, HasSubstr("picks of a horizon"));
}

TEST_F(Info, GoesOnAfterAFileItCannotRead) {
  write("prose.txt", "no numbers here\n");
  const test::Outcome outcome = run("info", "prose.txt picks.csv");
  EXPECT_NE(outcome.code, 0);
  EXPECT_THAT(outcome.errors, HasSubstr("prose.txt: is no point cloud"));
  EXPECT_THAT(outcome.output, HasSubstr("380 picks"));
  EXPECT_EQ(run("info", "").code, 2);
  EXPECT_EQ(run("info", "prose.txt --as fault").code, outcome.code);
  EXPECT_THAT(run("info", "picks.csv --columns 2,1,3").output, HasSubstr("x         5931000 to"));
}

} // namespace
} // namespace graben
