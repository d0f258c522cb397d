// Binary and object formats as others write them, and files whose headers say less than they hold.
#include "graben/io/mesh_reader.h"
#include "pick_samples.h"
#include "stick_samples.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace graben {
namespace {

using test::faultFailure;
using test::readFailure;
using test::readFaultText;
using test::readText;
using test::TempFolder;
using testing::Contains;
using testing::HasSubstr;
using testing::SizeIs;

const std::string three_rows = "0 0 1\n5 0 2\n0 5 3\n";

std::string ply(const std::string& element, const std::string& names, int count, const std::string& after = "") {
  std::string text = "ply\nformat ascii 1.0\nelement " + element + " " + std::to_string(count) + "\n";
  for (const char name : names)
    text += std::string("property float ") + name + "\n";
  return text + after + "end_header\n";
}

TEST(Ply, MayHaveCapitals) {
  EXPECT_THAT(readText(ply("Vertex", "XYZ", 3) + three_rows, "p.ply").points, SizeIs(3));
}

TEST(Ply, WithMoreRowsThanItsHeaderCountsIsRefused) {
  EXPECT_THAT(readFailure(ply("vertex", "xyz", 2) + three_rows, "p.ply"), HasSubstr("the header promises 2 vertices, but the file holds more"));
  const std::string mesh = ply("vertex", "xyz", 3, "element face 1\nproperty list uchar int vertex_indices\n") + three_rows + "3 0 1 2\n";
  EXPECT_THAT(readFaultText(mesh + "\n", "f.ply"), SizeIs(1));
  EXPECT_THAT(faultFailure(mesh + "3 0 2 1\n", "f.ply"), HasSubstr("3 vertices and 1 triangles, but the file holds more"));
  EXPECT_THAT(readText(mesh, "p.ply").points, SizeIs(3)) << "faces behind the picks are no more of them";
  std::string binary = "ply\nformat binary_little_endian 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
  binary += std::string("\0\0\0\0\0\0\0\0\0\0\x80\x3f\0\0\x80\x3f\0\0\0\0\0\0\0\0", 24);
  EXPECT_THAT(readText(binary + std::string(40, '\0'), "p.ply").points, SizeIs(2)) << "padding is nothing";
  EXPECT_THAT(readFailure(binary + std::string(12, '\1'), "p.ply"), HasSubstr("but the file holds more"));
}

TEST(Pcd, MayHaveCapitals) {
  const std::string header = "VERSION .7\nFIELDS X Y Z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 3\nHEIGHT 1\nPOINTS 3\nDATA ascii\n";
  EXPECT_THAT(readText(header + three_rows, "p.pcd").points, SizeIs(3));
}

const std::string surface = "GOCAD TSurf 1\nHEADER {\nname:F1\n}\nTFACE\nVRTX 1 0 0 1\nVRTX 2 5 0 2\nVRTX 3 0 5 3\nTRGL 1 2 3\nEND\n";
const std::string lines = "GOCAD PLine 1\nHEADER {\nname:Top\n}\nILINE\nVRTX 1 0 0 1\nVRTX 2 5 0 2\nSEG 1 2\nILINE\nVRTX 3 0 5 3\nVRTX 4 5 5 3\nSEG 3 4\nEND\n";

TEST(Gocad, MayHoldAGroup) {
  const auto faults = readFaultText("GOCAD HomogeneousGroup 1\nHEADER {\nname:all\n}\nTYPE TSurf\nBEGIN_MEMBERS\n" + surface + "END_MEMBERS\nEND\n", "f.ts");
  ASSERT_THAT(faults, SizeIs(1));
  EXPECT_EQ(faults[0].name, "F1");
  EXPECT_THAT(faults[0].warnings, testing::IsEmpty());
}

TEST(Gocad, SurfacesAndLinesMayBePicks) {
  EXPECT_THAT(readText(surface, "h.ts").points, SizeIs(3));
  const PickSet picks = readText(lines, "h.pl");
  EXPECT_THAT(picks.points, SizeIs(4));
  EXPECT_THAT(picks.notes, Contains(HasSubstr("the vertices of PLine taken as picks")));
  std::string other = lines;
  other.replace(other.find("Top"), 3, "Base");
  EXPECT_THAT(readFailure(lines + other, "h.pl"), HasSubstr("holds 2 horizons: Top, Base"));
}

TEST(Grids, MayHaveDecimalCommas) {
  const std::string grid = "ncols 3\nnrows 2\nxllcorner 100,0\nyllcorner 200,0\ncellsize 25,0\nNODATA_value -9999\n-1,5 -2,5 -3,5\n-4,5 -5,5 -9999\n";
  const PickSet picks = readText(grid, "g.asc");
  ASSERT_THAT(picks.points, SizeIs(5));
  EXPECT_THAT(picks.points, Contains(Vector3(112.5, 212.5, -4.5)));
}

TEST(Stl, InTextIsReadWithCapitalsAndSaysWhenItIsCut) {
  const std::string facet = "FACET NORMAL 0 0 1\nOUTER LOOP\nVERTEX 0 0 1\nVERTEX 5 0 2\nVERTEX 0 5 3\nENDLOOP\nENDFACET\n";
  const TempFolder folder;
  EXPECT_THAT(readMeshes(folder.write("a.stl", "SOLID F1\n" + facet + "ENDSOLID F1\n")).at(0).warnings, testing::IsEmpty());
  EXPECT_THAT(readMeshes(folder.write("b.stl", "solid F1\n" + facet)).at(0).warnings, Contains(HasSubstr("may be cut short")));
}

TEST(Off, IsNoTable) {
  EXPECT_THAT(readFailure("OFF\n3 1 0\n" + three_rows + "3 0 1 2\n", "p.off"), HasSubstr("is an OFF mesh, which is not read; convert it to PLY or OBJ"));
}

} // namespace
} // namespace graben
