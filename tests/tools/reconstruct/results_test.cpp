#include "support/tool.h"

#include "graben/io/mesh_reader.h"
#include "graben/mesh/triangle_bvh.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <pcl/PCLPointCloud2.h>
#include <pcl/io/pcd_io.h>

#include <algorithm>

namespace graben {
namespace {

using testing::HasSubstr;
using testing::IsSubsetOf;
using testing::StartsWith;

class ReconstructResults : public test::ToolTest {
protected:
  /// A sample of \a picks in the folder, named as the option says.
  void synthesize(const std::string& folder, const std::string& options) const {
    ASSERT_EQ(run("synthesize", "--quiet --output " + folder + " " + options).code, 0);
  }

  /// Runs the tool without pictures, which saves the time for them.
  test::Outcome reconstruct(const std::string& arguments) const { return run("reconstruct", arguments + " --pictures none"); }
};

TEST_F(ReconstructResults, FolderHoldsAllThatGoesWithTheSurface) {
  synthesize("s", "--kind branch --picks 3000 --origin 461000,5931000,1700 --z-positive down");
  const test::Outcome outcome = run(
      "reconstruct", "--horizon s/horizon.xyz --fault s/fault_1.ts s/fault_2.pol --z-positive down "
                     "--output top.ply --results out/results");
  ASSERT_EQ(outcome.code, 0) << outcome.errors;
  const std::set<std::string> files = names("out/results");
  EXPECT_THAT((std::set<std::string>{"surface.ply", "surface.vtk", "piece_1.ts", "piece_2.ts",
                                     "piece_3.ts", "fault_1_fault_1.ts", "fault_2_fault_2.ts",
                                     "picks.pcd", "report.json"}),
              IsSubsetOf(files));
  EXPECT_EQ(content("out/results/surface.ply"), content("top.ply"));
  EXPECT_THAT(content("top.ply"), HasSubstr("property double x"));
  for (const std::string picture : {"map", "pieces", "residuals", "section_1_fault_1", "throw_profile_2_fault_2", "allan_1_fault_1"}) {
    EXPECT_THAT(content("out/results/" + picture + ".png"), StartsWith("\x89PNG")) << picture;
    EXPECT_THAT(content("out/results/" + picture + ".svg"), StartsWith("<?xml")) << picture;
  }
  EXPECT_THAT(content("out/results/oblique.png"), StartsWith("\x89PNG"));
  const std::string page = content("out/results/report.html");
  for (const char* said : {"<h2>What went in</h2>", "<h2>Misfit</h2>", "<h2>Throws</h2>", "<h2>Time and memory</h2>", "--horizon horizon.xyz", "fault_2",
                           "on the wrong side of a fault", "data:image/png;base64,"})
    EXPECT_THAT(page, HasSubstr(said));
  EXPECT_LT(page.size(), 15000000U);

  const TriangleMesh top = readMesh(path("top.ply"));
  EXPECT_EQ(top.normals.size(), top.vertices.size());
  EXPECT_EQ(top.piece.size(), top.vertices.size());
  std::size_t triangles = 0;
  for (int piece = 1; piece <= 3; ++piece) {
    const std::string name = "out/results/piece_" + std::to_string(piece) + ".ts";
    const std::vector<MeshInput> parts = readMeshes(path(name));
    ASSERT_EQ(parts.size(), 1U);
    EXPECT_EQ(parts[0].z_positive, ZPositive::Down);
    triangles += parts[0].mesh.triangles.size();
    EXPECT_THAT(content(name), StartsWith("GOCAD TSurf 1\n"));
  }
  EXPECT_EQ(triangles, top.triangles.size());
  EXPECT_FALSE(readMesh(path("out/results/fault_2_fault_2.ts")).empty());
}

TEST_F(ReconstructResults, PicturesAreThoseAskedForAndNeedNoDisplay) {
  synthesize("s", "--kind normal --picks 1000");
  const std::string job = "--quiet --horizon s/horizon.xyz --fault s/fault_1.ts --results ";
  ASSERT_EQ(run("reconstruct", job + "p --pictures map,throws --picture-formats png,pdf", "DISPLAY= PATH=/nowhere").code, 0);
  EXPECT_THAT((std::set<std::string>{"map.png", "map.pdf", "throw_profile_1_fault_1.png", "throw_profile_1_fault_1.pdf"}), IsSubsetOf(names("p")));
  EXPECT_EQ(names("p").count("pieces.png") + names("p").count("map.svg"), 0U);
  for (const std::string wrong : {"--pictures maps", "--pictures none,map", "--picture-formats jpg"}) {
    const test::Outcome outcome = run("reconstruct", job + "q " + wrong);
    EXPECT_EQ(outcome.code, 2) << wrong;
    EXPECT_THAT(outcome.errors, HasSubstr("is not one of")) << wrong;
  }
  EXPECT_EQ(names().count("q"), 0U);
  ASSERT_EQ(run("reconstruct", job + "r --pictures none").code, 0);
  EXPECT_EQ(names("r"),
            (std::set<std::string>{"cutoffs_1_fault_1.pol", "fault_1_fault_1.ts", "fault_polygons.csv", "fault_polygons.dbf", "fault_polygons.geojson",
                                   "fault_polygons.shp", "fault_polygons.shx", "gap_1_fault_1.pol", "graben_reconstruct.manifest", "picks.pcd", "piece_1.ts",
                                   "piece_2.ts", "profile_1_fault_1.csv", "report.json", "set_aside.csv", "surface.cam", "surface.ply", "surface.vtk",
                                   "throw_1_fault_1.csv"}));
}

TEST_F(ReconstructResults, PicksSetAsideAreListedWithTheirReason) {
  synthesize("s", "--kind normal --picks 4000");
  ASSERT_EQ(reconstruct("--horizon s/horizon.xyz --fault s/fault_1.ts --results r --clearance 100").code, 0);
  std::istringstream table(content("r/set_aside.csv"));
  std::string line;
  std::getline(table, line);
  EXPECT_EQ(line, "pick,x,y,z,reason");
  std::size_t rows = 0;
  while (std::getline(table, line))
    rows += line.find("within the clearance of a fault") != std::string::npos ? 1 : 0;
  EXPECT_GT(rows, 50U);
  EXPECT_THAT(content("r/report.json"), HasSubstr("\"at_faults\": " + std::to_string(rows)));
}

TEST_F(ReconstructResults, ThrowProfilesHaveUnitsAndARowEverySoOften) {
  synthesize("s", "--kind reverse --picks 3000");
  ASSERT_EQ(reconstruct("--horizon s/horizon.xyz --fault s/fault_1.ts --results r --throw-interval 500 --xy-unit ft --z-unit ms").code, 0);
  std::istringstream profile(content("r/profile_1_fault_1.csv"));
  std::string line;
  std::getline(profile, line);
  EXPECT_EQ(line, "along [ft],x [ft],y [ft],footwall_z [ms],hanging_wall_z [ms],throw [ms],throw_p10 [ms],throw_p90 [ms],throw_sd [ms],"
                  "heave [ft],heave_p10 [ft],heave_p90 [ft],dip_slip [ft],dip_slip_p10 [ft],dip_slip_p90 [ft],fault_dip [deg],fault_dip_azimuth [deg]");
  double along = 0.0;
  for (; std::getline(profile, line); along += 500.0)
    EXPECT_EQ(std::stod(line), along);
  EXPECT_GT(along, 4000.0);
  const auto polygons = nlohmann::json::parse(content("r/fault_polygons.geojson"));
  ASSERT_EQ(polygons["features"].size(), 1U);
  EXPECT_EQ(polygons["features"][0]["properties"]["kind"], "overlap");
  const auto report = nlohmann::json::parse(content("r/report.json"));
  EXPECT_EQ(report["faults"][0]["gap_area"], 0.0);
  EXPECT_NEAR(report["faults"][0]["overlap_area"], polygons["features"][0]["properties"]["area"].get<double>(), 1e-6);
}

TEST_F(ReconstructResults, PicksOpenInPclWithNormalsAndPiece) {
  synthesize("s", "--kind normal --picks 2000 --origin 461000,5931000,1700");
  ASSERT_EQ(reconstruct("--horizon s/horizon.xyz --fault s/fault_1.ts --results r").code, 0);
  pcl::PCLPointCloud2 cloud;
  ASSERT_EQ(pcl::io::loadPCDFile(path("r/picks.pcd"), cloud), 0);
  EXPECT_EQ(cloud.width * cloud.height, 2000U);
  std::set<std::string> fields;
  for (const auto& field : cloud.fields)
    fields.insert(field.name);
  EXPECT_THAT((std::set<std::string>{"x", "y", "z", "normal_x", "normal_y", "normal_z"}),
              IsSubsetOf(fields));
  EXPECT_GE(fields.size(), 7U); // and the piece
}

TEST_F(ReconstructResults, ASecondRunLeavesNoPiecesOfTheFirst) {
  synthesize("s", "--kind branch --picks 1500");
  write("mine.txt", "mine");
  std::filesystem::create_directory(path("r"));
  std::filesystem::copy(path("mine.txt"), path("r/mine.txt"));
  ASSERT_EQ(
      reconstruct("--horizon s/horizon.xyz --fault s/fault_1.ts s/fault_2.ts --results r").code, 0);
  EXPECT_EQ(names("r").count("piece_3.ts"), 1U);
  ASSERT_EQ(reconstruct("--horizon s/horizon.xyz --fault s/fault_1.ts --results r").code, 0);
  EXPECT_EQ(names("r").count("piece_2.ts"), 1U);
  EXPECT_EQ(names("r").count("piece_3.ts"), 0U);
  EXPECT_EQ(content("r/mine.txt"), "mine");
}

TEST_F(ReconstructResults, ReportIsJsonWithTheSameFiguresAsTheFolder) {
  synthesize("s", "--kind tip --picks 2000");
  ASSERT_EQ(
      reconstruct("--horizon s/horizon.xyz --fault s/fault_1.ts --results r --report other.json")
          .code,
      0);
  const auto report = nlohmann::json::parse(content("r/report.json"));
  EXPECT_EQ(report, nlohmann::json::parse(content("other.json")));
  EXPECT_EQ(report["picks"]["count"], 2000);
  EXPECT_EQ(report["topology"]["pieces"], 1);
  EXPECT_EQ(report["topology"]["triangles"], readMesh(path("r/surface.ply")).triangles.size());
  EXPECT_EQ(report["faults"].size(), 1U);
  EXPECT_GT(report["stages"].size(), 5U);
}

/// Every key of a report, at any depth.
void listKeys(const nlohmann::json& tree, std::set<std::string>& keys) {
  if (!tree.is_structured())
    return;
  for (const auto& [key, value] : tree.items()) {
    if (tree.is_object())
      keys.insert(key);
    listKeys(value, keys);
  }
}

TEST_F(ReconstructResults, TheReportsKeysAreExplained) {
  synthesize("s", "--kind branch --picks 1500");
  ASSERT_EQ(reconstruct("--horizon s/horizon.xyz --fault s/fault_1.ts s/fault_2.ts --output top.ply --report report.json --hold-out").code, 0);
  std::ifstream file(GRABEN_SOURCE_DIR "/config/documentation/report.md");
  const std::string explained((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  const auto report = nlohmann::json::parse(content("report.json"));
  std::set<std::string> keys;
  listKeys(report, keys);
  for (const std::string& key : keys)
    EXPECT_THAT(explained, HasSubstr("`" + key + "`"));
  EXPECT_THAT(explained, HasSubstr("`schema_version` is " + std::to_string(report["schema_version"].get<int>())));
}

TEST_F(ReconstructResults, ProgressIsToldEachSecondButNotUnasked) {
  synthesize("s", "--kind normal --picks 60000");
  const std::string arguments = "--horizon s/horizon.xyz --fault s/fault_1.ts --output top.ply --threads 1 ";
  const test::Outcome asked = reconstruct(arguments + "--progress");
  ASSERT_EQ(asked.code, 0);
  EXPECT_THAT(asked.errors, StartsWith("progress: "));
  const auto report = asked.output.find("reading ");
  ASSERT_NE(report, std::string::npos) << "time and memory of each stage";
  EXPECT_THAT(asked.output.substr(report), testing::AllOf(HasSubstr("writing "), HasSubstr(" MB, peak ")));
  EXPECT_THAT(reconstruct(arguments).errors, testing::Not(HasSubstr("progress: ")));
}

TEST_F(ReconstructResults, DipsFromATableAreUsedAndCounted) {
  synthesize("s", "--kind normal --picks 2000");
  const std::string row = content("s/horizon.xyz").substr(0, content("s/horizon.xyz").find('\n'));
  std::string place = row;
  std::replace(place.begin(), place.end(), ' ', ',');
  write("dips.csv", "x,y,z,strike,dip\n" + place + ",0,10\n0,0,1000000,0,10\n");
  const test::Outcome outcome = reconstruct("--horizon s/horizon.xyz --fault s/fault_1.ts --dips dips.csv --results r");
  ASSERT_EQ(outcome.code, 0) << outcome.errors;
  EXPECT_THAT(outcome.errors, HasSubstr("warning: 1 of 2 dip measurements lie far from all picks"));
  EXPECT_THAT(outcome.output, HasSubstr("1 of 2 measurements used"));
  const auto report = nlohmann::json::parse(content("r/report.json"));
  EXPECT_EQ(report["dip_measurements"]["count"], 2);
  EXPECT_EQ(report["picks"]["count"], 2000);
  pcl::PCLPointCloud2 cloud;
  ASSERT_EQ(pcl::io::loadPCDFile(path("r/picks.pcd"), cloud), 0);
  EXPECT_EQ(cloud.width * cloud.height, 2000U);
}

TEST_F(ReconstructResults, ThrowsAndDistancesToPicksAreWritten) {
  synthesize("s", "--kind normal --picks 4000");
  ASSERT_EQ(reconstruct("--horizon s/horizon.xyz --fault s/fault_1.ts --results r --output top.ts --gocad-properties").code, 0);
  EXPECT_THAT(content("r/throw_1_fault_1.csv"),
              StartsWith("x [m],y [m],z [m],hanging_wall_x [m],hanging_wall_y [m],hanging_wall_z [m],along [m],throw [m],heave [m],dip_slip [m],mark\n"));
  const auto report = nlohmann::json::parse(content("r/report.json"));
  EXPECT_GT(report["faults"][0]["throw"]["samples"], 50);
  EXPECT_NEAR(report["faults"][0]["throw"]["mean"], 83.0, 4.0);
  for (const std::string file : {"r/surface.ply", "top.ts"}) {
    const TriangleMesh mesh = readMesh(path(file));
    ASSERT_EQ(mesh.scalars.count("pick_distance"), 1U) << file;
    EXPECT_EQ(mesh.scalars.at("extrapolated").size(), mesh.vertices.size()) << file;
  }
  EXPECT_THAT(content("r/surface.vtk"), HasSubstr("pick_distance"));
}

TEST_F(ReconstructResults, OneAndFourThreadsGiveTheSameBytes) {
  synthesize("s", "--kind branch --picks 10000 --origin 461000,5931000,1700");
  const std::string arguments =
      "--horizon s/horizon.xyz --fault s/fault_1.ts s/fault_2.ts --quiet ";
  ASSERT_EQ(reconstruct(arguments + "--threads 1 --output one.ply --results one").code, 0);
  ASSERT_EQ(reconstruct(arguments + "--threads 4 --output four.ply --results four").code, 0);
  EXPECT_TRUE(content("one.ply") == content("four.ply"));
  EXPECT_EQ(names("one"), names("four"));
  for (const std::string& name : names("one"))
    if (name != "report.json" && name.find(".png") == std::string::npos) {
      EXPECT_TRUE(content("one/" + name) == content("four/" + name)) << name;
    }
  auto one = nlohmann::json::parse(content("one/report.json"));
  auto four = nlohmann::json::parse(content("four/report.json"));
  one.erase("stages");
  four.erase("stages");
  EXPECT_EQ(one, four);
}

/// The same picks near the origin and in UTM give the same surface to the millimetre.
TEST_F(ReconstructResults, CoordinatesComeBackInUtmToTheMillimetre) {
  const Vector3 shift(461040.0, 5931000.0, 1680.0); // whole voxels, so that the lattices agree
  synthesize("near", "--kind reverse --picks 3000 --origin 37,53,11");
  synthesize("utm", "--kind reverse --picks 3000 --origin 461077,5931053,1691");
  for (const std::string folder : {"near", "utm"})
    ASSERT_EQ(reconstruct("--horizon " + folder + "/horizon.xyz --fault " + folder +
                          "/fault_1.ts --voxel-size 120 --output " + folder + ".ply --quiet")
                  .code,
              0);
  const TriangleMesh near = readMesh(path("near.ply"));
  const TriangleMesh utm = readMesh(path("utm.ply"));
  ASSERT_EQ(utm.vertices.size(), near.vertices.size());
  ASSERT_EQ(utm.triangles.size(), near.triangles.size());
  const TriangleBvh bvh(near);
  double farthest = 0.0;
  for (const Vector3& vertex : utm.vertices)
    farthest = std::max(farthest, bvh.nearest(vertex - shift).distance);
  EXPECT_LT(farthest, 0.001);
}

TEST_F(ReconstructResults, EveryFormatIsWritten) {
  synthesize("s", "--kind normal --picks 1000");
  std::size_t triangles = 0;
  for (const std::string extension : {"ply", "vtk", "vtp", "obj", "stl", "ts"}) {
    ASSERT_EQ(run("reconstruct",
                  "--horizon s/horizon.xyz --fault s/fault_1.pol --output top." + extension)
                  .code,
              0)
        << extension;
    const TriangleMesh mesh = readMesh(path("top." + extension));
    EXPECT_FALSE(mesh.empty()) << extension;
    if (triangles != 0 && extension != "stl") {
      EXPECT_EQ(mesh.triangles.size(), triangles) << extension;
    }
    triangles = mesh.triangles.size();
  }
}

} // namespace
} // namespace graben
