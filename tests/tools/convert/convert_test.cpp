#include "support/tool.h"

#include "graben/io/fault_reader.h"
#include "graben/io/mesh_reader.h"
#include "graben/io/pick_reader.h"

#include <gmock/gmock.h>

#include <cmath>
#include <cstdio>

#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>
#include <pcl/point_types.h>

namespace graben {
namespace {

using testing::HasSubstr;

class Convert : public test::ToolTest {
protected:
  void SetUp() override {
    ToolTest::SetUp();
    std::string text = "X_m,Y_m,Depth_ft\n";
    char row[100];
    for (int i = 0; i < 60; ++i) {
      points.emplace_back(461000.125 + 25.1 * (i % 10), 5931000.5 + 24.9 * (i / 10), 1800.25 + 0.3 * i);
      std::snprintf(row, sizeof row, "%.17g,%.17g,%.17g\n", points.back().x(), points.back().y(), points.back().z());
      text += row;
    }
    write("picks.csv", text);
    write("sticks.csv", "X,Y,Z,name,stick\n1.5,2,-1400,F one,1\n3.25,2,-1600,F one,1\n1,100,-1400,F one,2\n3,100,-1600.125,F one,2\n"
                        "9,2,-1400,F2,7\n9.5,2,-1600,F2,7\n8,100,-1400,F2,8\n9,100,-1600,F2,8\n");
    write("surface.ts", "GOCAD TSurf 1\nHEADER {\nname:F2\n}\nZPOSITIVE Depth\nPROPERTIES throw\nNO_DATA_VALUES -99999\nTFACE\n"
                        "PVRTX 1 461000.125 5931000.5 0.5 7\nPVRTX 2 461001.5 5931000 0 8\nPVRTX 3 461000 5931001 0 9\nTRGL 1 2 3\n"
                        "TFACE\nPVRTX 4 461010 5931000 0 1\nPVRTX 5 461011 5931000 0 2\nPVRTX 6 461010 5931001 0 -99999\nTRGL 4 5 6\nEND\n");
  }

  void convert(const std::string& arguments) const {
    const test::Outcome outcome = run("convert", arguments);
    EXPECT_EQ(outcome.code, 0) << arguments << "\n" << outcome.errors;
  }

  /// The farthest any of the points read is off.
  double farthestOff(const std::string& file) const {
    const PickSet picks = readPicks(path(file));
    EXPECT_EQ(picks.points.size(), points.size()) << file;
    double off = 0.0;
    for (std::size_t i = 0; i < std::min(points.size(), picks.points.size()); ++i)
      off = std::max(off, (picks.points[i] - points[i]).norm());
    return off;
  }

  Points points;
};

TEST_F(Convert, PicksKeepEveryBitWhereTheFormatHoldsThem) {
  for (const char* file : {"a.csv", "a.xyz", "a.poi", "a.ply", "a.vs"}) {
    convert(std::string("picks.csv ") + file);
    EXPECT_EQ(farthestOff(file), 0.0) << file;
  }
  convert("picks.csv double.pcd --double");
  EXPECT_EQ(farthestOff("double.pcd"), 0.0);
  convert("picks.csv a.pcd");
  convert("picks.csv float.ply --float");
  EXPECT_LT(farthestOff("a.pcd"), 2e-5);
  EXPECT_LT(farthestOff("float.ply"), 2e-5);
  const PickSet vset = readPicks(path("a.vs"));
  EXPECT_EQ(vset.z_positive, ZPositive::Down);
  EXPECT_EQ(vset.z_unit, "ft");
  EXPECT_THAT(content("a.csv"), HasSubstr("X_m,Y_m,Depth_ft\n"));
}

TEST_F(Convert, PclReadsWhatIsWrittenForIt) {
  convert("picks.csv a.pcd");
  convert("picks.csv a.ply --float");
  EXPECT_THAT(content("a.pcd"), HasSubstr("# origin 461113 5931063 1809"));
  EXPECT_THAT(content("a.ply"), HasSubstr("comment origin 461113 5931063 1809"));
  pcl::PointCloud<pcl::PointXYZ> cloud;
  ASSERT_EQ(pcl::io::loadPCDFile(path("a.pcd"), cloud), 0);
  ASSERT_EQ(cloud.size(), points.size());
  EXPECT_NEAR(cloud[7].x + 461113.0, points[7].x(), 1e-4);
  ASSERT_EQ(pcl::io::loadPLYFile(path("a.ply"), cloud), 0);
  ASSERT_EQ(cloud.size(), points.size());
  EXPECT_NEAR(cloud[7].z + 1809.0, points[7].z(), 1e-4);
  EXPECT_NE(cloud[7].z, 0.0F);
}

TEST_F(Convert, SticksKeepNamesAndOrder) {
  const auto given = readFaults(path("sticks.csv"));
  ASSERT_EQ(given.size(), 2U);
  for (const char* file : {"a.csv", "a.pl"}) {
    convert(std::string("sticks.csv ") + file);
    const auto faults = readFaults(path(file));
    ASSERT_EQ(faults.size(), 2U) << file;
    for (std::size_t f = 0; f < 2; ++f) {
      EXPECT_EQ(faults[f].name, given[f].name);
      const auto& sticks = std::get<std::vector<FaultStick>>(faults[f].geometry);
      const auto& wanted = std::get<std::vector<FaultStick>>(given[f].geometry);
      ASSERT_EQ(sticks.size(), 2U);
      for (std::size_t s = 0; s < 2; ++s)
        EXPECT_EQ(sticks[s].points, wanted[s].points) << file;
    }
  }
  const test::Outcome pol = run("convert", "sticks.csv a.pol");
  EXPECT_THAT(pol.errors, HasSubstr("no place for names"));
  EXPECT_EQ(std::get<std::vector<FaultStick>>(readFaults(path("a.pol"))[0].geometry).size(), 4U);
  convert("sticks.csv a.geojson");
  EXPECT_THAT(content("a.geojson"),
              HasSubstr("{\"name\":\"F one\",\"stick\":1},\"geometry\":{\"type\":\"LineString\",\"coordinates\":[[1.5,2,-1400],[3.25,2,-1600]]}}"));
  convert("a.pl a.ts");
  EXPECT_FALSE(readMesh(path("a.ts")).triangles.empty());
}

TEST_F(Convert, SurfacesKeepTrianglesAndProperties) {
  const TriangleMesh given = readMesh(path("surface.ts"));
  for (const char* file : {"a.ply", "a.vtk", "a.vtp", "a.obj", "a.ts"}) {
    convert(std::string("surface.ts ") + file);
    const TriangleMesh mesh = readMesh(path(file));
    EXPECT_EQ(mesh.vertices, given.vertices) << file;
    EXPECT_EQ(mesh.triangles, given.triangles) << file;
  }
  EXPECT_EQ(readMesh(path("a.vtp")).scalars.at("throw")[1], 8.0F);
  EXPECT_THAT(content("a.ts"), HasSubstr("ZPOSITIVE Depth"));
}

TEST_F(Convert, FullGocadHasFacesPropertiesAndBorders) {
  convert("surface.ts full.ts --gocad-full");
  const std::string text = content("full.ts");
  EXPECT_THAT(text, HasSubstr("PROPERTIES piece throw"));
  EXPECT_THAT(text, HasSubstr("TRGL 1 2 3\nTFACE\nPVRTX 4 461010"));
  EXPECT_THAT(text, HasSubstr("BSTONE 1\nBSTONE 4\nBORDER 7 1 2\nBORDER 8 4 5\nEND\n"));
  const TriangleMesh mesh = readMesh(path("full.ts"));
  const TriangleMesh given = readMesh(path("surface.ts"));
  EXPECT_EQ(mesh.vertices, given.vertices);
  EXPECT_EQ(mesh.piece, given.piece);
  EXPECT_EQ(mesh.scalars.at("throw")[2], 9.0F);
  EXPECT_TRUE(std::isnan(mesh.scalars.at("throw")[5]));
  convert("surface.ts plain.ts");
  EXPECT_EQ(content("plain.ts").find("TFACE"), content("plain.ts").rfind("TFACE"));
  EXPECT_EQ(content("plain.ts").find("PROPERTIES"), std::string::npos);
}

TEST_F(Convert, ScalesAndTurns) {
  convert("picks.csv m.vs --scale 1,1,-0.3048");
  const PickSet picks = readPicks(path("m.vs"));
  EXPECT_NEAR(picks.points[3].z(), -0.3048 * points[3].z(), 1e-9);
  EXPECT_EQ(picks.z_positive, ZPositive::Up);
  convert("surface.ts up.ts --scale 1,1,-1");
  EXPECT_EQ(readMesh(path("up.ts")).triangles[0], (Triangle{0, 2, 1}));
}

TEST_F(Convert, RefusesWhatItCannotDo) {
  EXPECT_EQ(run("convert", "picks.csv a.stl").code, 2);
  EXPECT_EQ(run("convert", "picks.csv a.unknown").code, 2);
  EXPECT_EQ(run("convert", "picks.csv ./picks.csv").code, 2);
  EXPECT_EQ(run("convert", "picks.csv").code, 2);
  EXPECT_EQ(run("convert", "picks.csv a.xyz --scale 1,0,1").code, 2);
  EXPECT_NE(run("convert", "absent.csv a.xyz").code, 0);
  EXPECT_EQ(content("picks.csv").substr(0, 4), "X_m,");
  EXPECT_EQ(names().count("a.stl") + names().count("a.unknown"), 0U);
}

} // namespace
} // namespace graben
