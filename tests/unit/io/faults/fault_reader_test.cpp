#include "graben/core/errors.h"
#include "graben/io/fault_reader.h"
#include "graben/io/pick_writer.h"
#include "support/temp_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace graben {
namespace {

using test::TempFolder;
using testing::Contains;
using testing::HasSubstr;

std::vector<FaultInput> read(const std::string& content, const std::string& name) {
  const TempFolder folder;
  return readFaults(folder.write(name, content));
}

std::string failure(const std::string& content, const std::string& name) {
  try {
    read(content, name);
  } catch (const ParseError& error) {
    return error.what();
  }
  return {};
}

const std::vector<FaultStick>& sticksOf(const FaultInput& fault) {
  return std::get<std::vector<FaultStick>>(fault.geometry);
}

const TriangleMesh& meshOf(const FaultInput& fault) {
  return std::get<TriangleMesh>(fault.geometry);
}

const std::string two_sticks = "500100.5 6000000.25 1500\n500140 6000010 1900\n999.0 999.0 999.0\n"
                               "500090 6000200 1500\n500130 6000210 1900\n";

TEST(PolReader, readsSticksWithOrWithoutTheLastTerminator) {
  for (const char* end : {"", "999.000000 999.000000 999.000000\n", "999 999 999"}) {
    const auto faults = read(two_sticks + end, "F1.pol");
    ASSERT_EQ(faults.size(), 1U);
    EXPECT_EQ(faults[0].name, "F1");
    ASSERT_EQ(sticksOf(faults[0]).size(), 2U);
    EXPECT_EQ(sticksOf(faults[0])[0].points[0], Vector3(500100.5, 6000000.25, 1500));
    EXPECT_EQ(sticksOf(faults[0])[1].points.size(), 2U);
    EXPECT_EQ(faults[0].z_positive, ZPositive::Unknown);
  }
}

TEST(PolReader, writesWhatItReads) {
  const TempFolder folder;
  const auto faults = readFaults(folder.write("a.pol", two_sticks));
  writePol(folder.path("b.pol"), sticksOf(faults[0]));
  const auto again = readFaults(folder.path("b.pol"));
  ASSERT_EQ(sticksOf(again[0]).size(), 2U);
  for (std::size_t s = 0; s < 2; ++s)
    EXPECT_EQ(sticksOf(again[0])[s].points, sticksOf(faults[0])[s].points);
}

TEST(PolReader, takesEmptyRowsForEndsAndWindowsLines) {
  const auto faults = read("1 2 3\r\n4 5 6\r\n\r\n7 8 9\r\n1 1 1\r\n", "F.dufault");
  EXPECT_EQ(sticksOf(faults[0]).size(), 2U);
}

TEST(PolReader, dropsOnePointSticksWithANote) {
  const auto faults = read(two_sticks + "999 999 999\n1 2 3\n999 999 999\n", "F.pol");
  EXPECT_EQ(sticksOf(faults[0]).size(), 2U);
  EXPECT_THAT(faults[0].notes, Contains(HasSubstr("1 sticks with fewer than two points")));
}

TEST(PolReader, refusesWhatIsNoSticks) {
  EXPECT_THAT(read("1 2 3\n4 5 6\n7 8 9\n", "F.pol")[0].notes, Contains(HasSubstr("without any end of line")));
  EXPECT_THAT(failure("some prose\nmore prose\n", "F.pol"), HasSubstr("is no fault"));
  EXPECT_THAT(failure("1 2 3\n4 five 6\n999 999 999\n", "F.pol"), HasSubstr("F.pol:2: "));
  EXPECT_THAT(failure("1 2 3\n999 999 999\n", "F.pol"), HasSubstr("two points or more"));
  EXPECT_THAT(failure("", "F.pol"), HasSubstr("is empty"));
}

const std::string two_surfaces =
    "GOCAD TSurf 1\nHEADER {\nname:\" F one\"\n*solid*color:1 0 0 1\n}\n"
    "GOCAD_ORIGINAL_COORDINATE_SYSTEM\nNAME Default\nAXIS_NAME \"X\" \"Y\" \"Z\"\n"
    "ZPOSITIVE Depth\nEND_ORIGINAL_COORDINATE_SYSTEM\n"
    "PROPERTIES throw\nPROPERTY_CLASS_HEADER Z {\nkind:Depth\n}\n# comment\n"
    "TFACE\nPVRTX 0 500000 6000000 1800 12.5 CNXYZ\nVRTX 7 500100 6000000 1810\n"
    "VRTX 3 500050 6000090 1.805e3\nTRGL 0 7 3\nTFACE\nPATOM 9 7 11.0\nATOM 10 3\n"
    "VRTX 11 500200 6000000 1850\nTRGL 9 11 10\nBSTONE 9\nBORDER 12 9 11\nEND\n"
    "GOCAD TSurf 1\nTFACE\nVRTX 1 0 0 0\nVRTX 2 1 0 0\nVRTX 3 0 1 0\nTRGL 1 2 3\n";

TEST(GocadReader, readsTsurfsAsTheyComeInRealFiles) {
  const auto faults = read(two_surfaces, "faults.ts");
  ASSERT_EQ(faults.size(), 2U);
  EXPECT_EQ(faults[0].name, "F one");
  EXPECT_EQ(faults[0].z_positive, ZPositive::Down);
  EXPECT_EQ(faults[1].name, "faults");
  EXPECT_EQ(faults[1].z_positive, ZPositive::Unknown);
  const TriangleMesh& mesh = meshOf(faults[0]);
  ASSERT_EQ(mesh.vertices.size(), 6U);
  EXPECT_EQ(mesh.vertices[3], mesh.vertices[1]);
  EXPECT_EQ(mesh.vertices[2], Vector3(500050, 6000090, 1805));
  EXPECT_EQ(mesh.triangles[1], (Triangle{3, 5, 4}));
  EXPECT_EQ(mesh.piece, (std::vector<Index>{0, 0, 0, 1, 1, 1}));
}

TEST(GocadReader, namesTheLineOfAFault) {
  EXPECT_THAT(
      failure("GOCAD TSurf 1\nTFACE\nVRTX 1 0 0 0\nVRTX 2 1 0 0\nTRGL 1 2 3\nEND\n", "a.ts"),
      HasSubstr("a.ts:5: vertex 3 is not defined"));
  EXPECT_THAT(failure("GOCAD TSurf 1\nTFACE\nVRTX 1 0 x 0\nEND\n", "a.ts"), HasSubstr("a.ts:3: "));
  EXPECT_THAT(failure("GOCAD TSurf 1\nVRTX 1 0 0 0\nVRTX 1 0 0 0\nEND\n", "a.ts"),
              HasSubstr("defined twice"));
  EXPECT_THAT(failure("GOCAD TSurf 1\nVRTX 1 0 nan 0\n", "a.ts"), HasSubstr("finite"));
  EXPECT_THAT(failure("GOCAD TSurf 1\nTRGL 1\n", "a.ts"), HasSubstr("a.ts:2: "));
  EXPECT_THAT(failure("GOCAD VSet 1\nVRTX 1 0 0 0\nEND\n", "a.ts"), HasSubstr("found: VSet"));
  EXPECT_THAT(failure("not gocad\n", "a.ts"), HasSubstr("a.ts:1: "));
}

TEST(GocadReader, readsPlinesByIlineAndBySegment) {
  const std::string head = "GOCAD PLine 1\nHEADER {name: F1_sticks}\n";
  const auto by_iline =
      read(head + "ILINE\nVRTX 1 1 0 0\nVRTX 2 2 0 0\nSEG 1 2\nILINE\nVRTX 3 3 0 0\nVRTX 4 4 0 0\n"
                  "VRTX 5 5 0 0\nSEG 3 4\nSEG 4 5\nEND\n",
           "sticks.pl");
  EXPECT_EQ(by_iline[0].name, "F1_sticks");
  ASSERT_EQ(sticksOf(by_iline[0]).size(), 2U);
  EXPECT_EQ(sticksOf(by_iline[0])[1].points.size(), 3U);
  const auto by_segment =
      read(head + "VRTX 1 1 0 0\nVRTX 2 2 0 0\nVRTX 3 3 0 0\nVRTX 4 4 0 0\nSEG 1 2\nSEG 3 4\nEND\n",
           "sticks.pl");
  EXPECT_EQ(sticksOf(by_segment[0]).size(), 2U);
  const auto without = read(head + "ILINE\nVRTX 1 1 0 0\nVRTX 2 2 0 0\nEND", "sticks.pl");
  EXPECT_EQ(sticksOf(without[0])[0].points[1], Vector3(2, 0, 0));
}

TEST(CharismaReader, readsTheVariantsThatExist) {
  const std::string text = "INLINE-     784    604    500100.5   6000000   1500 F 1 1\n"
                           "INLINE-     784    642    500140     6000010   1900 F 1 1\n"
                           "INLINE - 734 608 500090 6000200 1500 F 1 2\n"
                           "INLINE : 734 XLINE : 638 500130 6000210 1900 F 1 2\n"
                           "INLINE-784 604 1 2 3 \"G\" 7\n"
                           "INLINE-\t784\t604\t4\t5\t6\t\"G\"\t7\r\n";
  const auto faults = read(text, "faultsticks");
  ASSERT_EQ(faults.size(), 2U);
  EXPECT_EQ(faults[0].name, "F 1");
  ASSERT_EQ(sticksOf(faults[0]).size(), 2U);
  EXPECT_EQ(sticksOf(faults[0])[0].points[0], Vector3(500100.5, 6000000, 1500));
  EXPECT_EQ(sticksOf(faults[0])[1].points[1], Vector3(500130, 6000210, 1900));
  EXPECT_EQ(faults[1].name, "G");
  EXPECT_EQ(sticksOf(faults[1])[0].points[1], Vector3(4, 5, 6));
}

TEST(CharismaReader, refusesHorizons) {
  EXPECT_THAT(failure("INLINE :  784 XLINE :  604  500100.0 6000000.0 1500.0\n", "h.dat"),
              HasSubstr("horizon"));
}

TEST(Cps3Reader, readsLines) {
  const auto faults = read("FFASCI 0 1 \"LINES\" 0 1.0E+30\nFFATTR 0 1\n->1\n500100 6000000 -1500\n"
                           "500140 6000010 -1900\n->\n1 2 3\n4 5 6\n7 8 1.0E+30\n",
                           "lines.dat");
  ASSERT_EQ(sticksOf(faults[0]).size(), 2U);
  EXPECT_EQ(sticksOf(faults[0])[1].points.size(), 2U);
  EXPECT_THAT(faults[0].notes, Contains(HasSubstr("1 stick points without data")));
}

TEST(FaultReader, contentDecidesOverTheExtension) {
  EXPECT_EQ(read(two_surfaces, "faults.pol").size(), 2U);
  EXPECT_EQ(sticksOf(read(two_sticks, "sticks.txt")[0]).size(), 2U);
  const auto ply =
      read("ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
           "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
           "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
           "f.dat");
  EXPECT_EQ(meshOf(ply[0]).triangles.size(), 1U);
  EXPECT_THROW(readFaults("/nowhere/f.ts"), IoError);
}

} // namespace
} // namespace graben
