#include "support/tool.h"

#include "graben/io/fault_reader.h"
#include "graben/io/mesh_reader.h"
#include "graben/io/pick_reader.h"
#include "graben/mesh/components.h"
#include "graben/synthetic/synthetic_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace graben {
namespace {

namespace fs = std::filesystem;
using test::Outcome;
using testing::HasSubstr;

class Synthesize : public test::ToolTest {
protected:
  test::Outcome run(const std::string& arguments) const { return ToolTest::run("synthesize", arguments); }
};

TEST_F(Synthesize, WrongUseExitsWithTwoAndWritesNothing) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"", "--output DIR is missing"},
      {"--output d --pick 10", "unknown option --pick; did you mean --picks?"},
      {"--output d --picks many", "option --picks: 'many' is not a number"},
      {"--output d --picks 1.5", "--picks"},
      {"--output d --kind square", "option --kind: 'square' is not one of unfaulted, normal"},
      {"--output d --origin 1,2", "--origin"},
      {"--output d --hole 1,2", "--hole"},
      {"--output d --overhang 1,2,3", "--overhang"},
      {"--output d --sampling random", "option --sampling: 'random' is not one of scattered, grid, lines, contours"},
      {"--output d --line-distance 1,2,3", "--line-distance"},
      {"--output d --unpicked 0.2", "--unpicked"},
      {"--output", "--output needs a value"},
      {"stray", "'stray'"},
  };
  for (const auto& [arguments, message] : cases) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, 2) << arguments;
    EXPECT_THAT(outcome.errors, HasSubstr("graben_synthesize: error: "));
    EXPECT_THAT(outcome.errors, HasSubstr(message));
  }
  EXPECT_TRUE(names().empty());
}

TEST_F(Synthesize, ImpossibleRequestsAreErrors) {
  write("taken", "a file");
  EXPECT_EQ(run("--output d --dip 5").code, 1);
  EXPECT_THAT(run("--output d --hole 0,0,9000").errors, HasSubstr("no room for picks"));
  EXPECT_EQ(run("--output d --hole 0,0,9000").code, 1);
  const Outcome outcome = run("--output taken");
  EXPECT_EQ(outcome.code, 4);
  EXPECT_THAT(outcome.errors, HasSubstr("taken"));
  EXPECT_EQ(content("taken"), "a file");
}

TEST_F(Synthesize, HelpAndVersion) {
  const Outcome help = run("--help");
  EXPECT_EQ(help.code, 0);
  for (const std::string& name : syntheticKindNames())
    EXPECT_THAT(help.output, HasSubstr(name));
  EXPECT_EQ(run("--version").code, 0);
}

TEST_F(Synthesize, FilesReadBackAsTheModelSays) {
  const Outcome outcome = run("--output d/e --kind branch --picks 3000 --origin "
                              "461000,5931000,1700 --z-positive down --noise 0");
  ASSERT_EQ(outcome.code, 0) << outcome.errors;
  SyntheticOptions o = SyntheticOptions::of(SyntheticKind::Branch);
  o.picks = 3000;
  o.noise = 0.0;
  o.frame.origin = {461000.0, 5931000.0, 1700.0};
  o.frame.z_positive = ZPositive::Down;
  const SyntheticModel model(o);
  const PickSet picks = readPicks(path("d/e/horizon.xyz"));
  ASSERT_EQ(picks.points.size(), 3000u);
  for (std::size_t i = 0; i < picks.points.size(); ++i)
    EXPECT_LT((picks.points[i] - model.pick(i).position).norm(), 0.001);
  for (std::size_t i = 0; i < 2; ++i) {
    const std::string name = "d/e/fault_" + std::to_string(i + 1);
    const std::vector<FaultInput> surface = readFaults(path(name + ".ts"));
    ASSERT_EQ(surface.size(), 1u);
    EXPECT_EQ(surface[0].z_positive, ZPositive::Down);
    EXPECT_EQ(std::get<TriangleMesh>(surface[0].geometry).triangles.size(),
              model.faultMesh(i).triangles.size());
    const std::vector<FaultInput> sticks = readFaults(path(name + ".pol"));
    ASSERT_EQ(sticks.size(), 1u);
    EXPECT_EQ(std::get<std::vector<FaultStick>>(sticks[0].geometry).size(),
              model.faultSticks(i).size());
    for (const std::string wall : {"footwall", "hangingwall"})
      EXPECT_TRUE(
          fs::exists(path("d/e/cutoff_fault_" + std::to_string(i + 1) + "_" + wall + ".pol")));
  }
  const std::string readme = content("d/e/README.txt");
  EXPECT_THAT(readme, HasSubstr("graben_reconstruct --horizon horizon.xyz --fault fault_1.ts "
                                "fault_2.ts --z-positive down"));
  for (const auto& entry : fs::directory_iterator(path("d/e")))
    if (entry.path().filename() != "synthetic.json" && entry.path().extension() != ".manifest") {
      EXPECT_THAT(content("d/e/synthetic.json"),
                  HasSubstr('"' + entry.path().filename().string() + '"'));
    }
}

TEST_F(Synthesize, TruthReadsBackWithOnePiecePerBlock) {
  ASSERT_EQ(run("--output d --kind cross --picks 1000 --quiet").output, "");
  const TriangleMesh truth = readMesh(path("d/truth.ply"));
  EXPECT_EQ(connectedComponents(truth).triangle_count.size(), 4u);
  EXPECT_EQ(truth.normals.size(), truth.vertices.size());
  std::size_t triangles = 0;
  for (int block = 1; block <= 4; ++block)
    triangles += readMesh(path("d/truth_block_" + std::to_string(block) + ".ts")).triangles.size();
  EXPECT_EQ(triangles, truth.triangles.size());
}

TEST_F(Synthesize, EveryFormatHoldsTheSamePicks) {
  const SyntheticPicks expected = [] {
    SyntheticOptions o = SyntheticOptions::of(SyntheticKind::Tip);
    o.picks = 500;
    o.frame.origin = {500000.0, 6000000.0, 0.0};
    return SyntheticModel(o).picks();
  }();
  for (const std::string format : {"xyz", "poi", "pcd", "ply"}) {
    ASSERT_EQ(
        run("--output d --kind tip --picks 500 --origin 500000,6000000,0 --no-truth --format " +
            format)
            .code,
        0);
    const PickSet picks = readPicks(path("d/horizon." + format));
    ASSERT_EQ(picks.points.size(), 500u) << format;
    const double tolerance = format == "pcd" || format == "ply" ? 0.0 : 0.00087;
    for (std::size_t i = 0; i < 500; ++i)
      EXPECT_LE((picks.points[i] - expected.points[i]).norm(), tolerance) << format;
    EXPECT_FALSE(fs::exists(path("d/truth.ply")));
  }
  EXPECT_FALSE(fs::exists(path("d/horizon.xyz"))); // of the run before
}

TEST_F(Synthesize, PicksAlongLinesAreAsManyAsItSays) {
  const Outcome outcome =
      run("--output d --kind tip --sampling lines --line-distance 500,1000 --along-line 50 --azimuth 90 --shadow 100,200 --mistie 3 "
          "--unpicked 0.2,600 --no-truth");
  ASSERT_EQ(outcome.code, 0) << outcome.errors;
  const std::size_t count = readPicks(path("d/horizon.xyz")).points.size();
  EXPECT_GT(count, 1500u);
  EXPECT_LT(count, 2100u); // of 2420, and what the fault's heave and shadow take
  EXPECT_THAT(outcome.output, HasSubstr("Wrote " + std::to_string(count) + " picks"));
  EXPECT_THAT(content("d/README.txt"), HasSubstr(std::to_string(count) + " picks, lines, spacing about 50"));
  EXPECT_THAT(content("d/synthetic.json"), HasSubstr("\"cross_distance\": 1000,"));
}

TEST_F(Synthesize, ASecondRunLeavesNoFaultsOfTheFirstAndNothingElseIsTouched) {
  ASSERT_EQ(run("--output d --kind cross --picks 1000").code, 0);
  write("d/mine.txt", "mine");
  ASSERT_TRUE(fs::exists(path("d/fault_2.ts")));
  ASSERT_EQ(run("--output d --kind normal --picks 1000").code, 0);
  EXPECT_TRUE(fs::exists(path("d/fault_1.ts")));
  EXPECT_FALSE(fs::exists(path("d/fault_2.ts")));
  EXPECT_FALSE(fs::exists(path("d/truth_block_3.ts")));
  EXPECT_EQ(content("d/mine.txt"), "mine");
}

TEST_F(Synthesize, SameBytesForEveryNumberOfThreadsAndFromAConfigurationFile) {
  write("run.cfg", "kind = conjugate\npicks = 40000\nseed = 7\nhole = 0,0,300 900,900,200\n");
  ASSERT_EQ(run("--output a --config run.cfg --threads 1").code, 0);
  ASSERT_EQ(run("--output b --config run.cfg --threads 4").code, 0);
  ASSERT_EQ(
      run("--output c --kind conjugate --picks 40000 --seed 7 --hole 0,0,300 --hole 900,900,200")
          .code,
      0);
  for (const auto& entry : fs::directory_iterator(path("a"))) {
    const std::string name = entry.path().filename().string();
    EXPECT_EQ(content("a/" + name), content("b/" + name)) << name;
    EXPECT_EQ(content("a/" + name), content("c/" + name)) << name;
  }
}

} // namespace
} // namespace graben
