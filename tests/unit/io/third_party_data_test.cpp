#include "graben/io/fault_reader.h"
#include "graben/io/mesh_reader.h"
#include "graben/io/pick_reader.h"
#include "support/data.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <ostream>
#include <string>

namespace graben {
namespace {

struct CloudCase {
  const char* file;
  std::size_t points;
  std::size_t normals;
  ZPositive z_positive;

  friend void PrintTo(const CloudCase& cloud, std::ostream* out) { *out << cloud.file; }
};

/// A path as a name of a test: letters, digits and underscores.
std::string nameOfFile(std::string file) {
  std::replace_if(
      file.begin(), file.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return file;
}

class ThirdPartyPicks : public testing::TestWithParam<CloudCase> {};

TEST_P(ThirdPartyPicks, areReadInFull) {
  const CloudCase& expected = GetParam();
  GRABEN_REQUIRE_DATA(path, expected.file);
  const PickSet picks = readPicks(path);
  EXPECT_EQ(picks.points.size(), expected.points);
  EXPECT_EQ(picks.normals.size(), expected.normals);
  EXPECT_EQ(picks.z_positive, expected.z_positive);
  EXPECT_EQ(picks.rejected_rows, 0U);
}

INSTANTIATE_TEST_SUITE_P(
    Data, ThirdPartyPicks,
    testing::Values(CloudCase{"drogon/time/TopVolantis.poi", 25311, 0, ZPositive::Down},
                    CloudCase{"drogon/depth/TopTherys.poi", 32612, 0, ZPositive::Down},
                    CloudCase{"modelA4/H1b_points.xyz", 60000, 0, ZPositive::Unknown},
                    CloudCase{"clouds/bun0.pcd", 397, 397, ZPositive::Unknown},
                    CloudCase{"clouds/ism_train_horse.pcd", 3400, 0, ZPositive::Unknown},
                    CloudCase{"clouds/samp53-utm-ground.pcd", 32989, 0, ZPositive::Unknown},
                    CloudCase{"formats/Nimitz_Salmon_XY-and-ILXL_Single-line-header.dat", 1830, 0,
                              ZPositive::Unknown},
                    CloudCase{"formats/Segment_XY-and-ILXL_Multi-line-header.dat", 829, 0,
                              ZPositive::Unknown}),
    [](const auto& tested) { return nameOfFile(tested.param.file); });

TEST(ThirdPartyData, opendtectZComesFromTheNamedColumn) {
  GRABEN_REQUIRE_DATA(single, "formats/Nimitz_Salmon_XY-and-ILXL_Single-line-header.dat");
  EXPECT_EQ(readPicks(single).points[0], Vector3(1709752.38, 5828111.45, 531.371772289276123));
  GRABEN_REQUIRE_DATA(multi, "formats/Segment_XY-and-ILXL_Multi-line-header.dat");
  EXPECT_EQ(readPicks(multi).points[0], Vector3(620986.88, 6080882.36, 648.61750602722168));
}

TEST(ThirdPartyData, sticksAreReadInFull) {
  const std::size_t sticks[] = {32, 62, 18, 15, 11, 17};
  for (std::size_t i = 0; i < 6; ++i) {
    GRABEN_REQUIRE_DATA(path, "drogon/depth/F" + std::to_string(i + 1) + ".pol");
    const auto faults = readFaults(path);
    ASSERT_EQ(faults.size(), 1U);
    EXPECT_EQ(std::get<std::vector<FaultStick>>(faults[0].geometry).size(), sticks[i]);
    EXPECT_TRUE(faults[0].notes.empty());
  }
  GRABEN_REQUIRE_DATA(charisma, "formats/faultsticks");
  const auto faults = readFaults(charisma);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].name, "gp_fault7");
  EXPECT_EQ(std::get<std::vector<FaultStick>>(faults[0].geometry).size(), 4U);
}

struct MeshCase {
  const char* file;
  std::size_t vertices;
  std::size_t triangles;

  friend void PrintTo(const MeshCase& mesh, std::ostream* out) { *out << mesh.file; }
};

class ThirdPartyMeshes : public testing::TestWithParam<MeshCase> {};

TEST_P(ThirdPartyMeshes, areReadInFull) {
  const MeshCase& expected = GetParam();
  GRABEN_REQUIRE_DATA(path, expected.file);
  const auto meshes = readMeshes(path);
  ASSERT_EQ(meshes.size(), 1U);
  EXPECT_EQ(meshes[0].mesh.vertices.size(), expected.vertices);
  EXPECT_EQ(meshes[0].mesh.triangles.size(), expected.triangles);
  EXPECT_EQ(meshes[0].z_positive, ZPositive::Up);
}

INSTANTIATE_TEST_SUITE_P(
    Data, ThirdPartyMeshes,
    testing::Values(MeshCase{"modelA4/F1fault.ts", 1341, 1998},
                    MeshCase{"modelA4/F2fault.ts", 2174, 3380},
                    MeshCase{"modelA4/H1b_truth.ts", 4742, 9001},
                    MeshCase{"cfm/OCBA-PVFZ-MULT-Palos_Verdes_fault-CFM6.ts", 3415, 5262},
                    MeshCase{"cfm/SFBY-NCRH-MULT-Hayward_Rogers_Creek-CFM7.ts", 2804, 4947},
                    MeshCase{"cfm/WTRA-NCVS-PPTV-Pitas_Point_fault_east-CFM6_500m.ts", 5909,
                             11511}),
    [](const auto& tested) { return nameOfFile(tested.param.file); });

} // namespace
} // namespace graben
