#include "support/tool.h"

#include "graben/io/mesh_reader.h"
#include "graben/io/mesh_writer.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace graben {
namespace {

using testing::HasSubstr;
using Json = nlohmann::json;

class Evaluate : public test::ToolTest {
protected:
  void synthesize(const std::string& options) const {
    ASSERT_EQ(run("synthesize", "--quiet --output s --picks 2000 " + options).code, 0);
  }

  Json report(const std::string& arguments, int code = 0) const {
    const test::Outcome outcome = run("evaluate", arguments + " --report r.json");
    EXPECT_EQ(outcome.code, code) << outcome.errors;
    return Json::parse(content("r.json"), nullptr, false);
  }

  static double value(const Json& report, const std::string& figure) {
    for (const Json& f : report["figures"])
      if (f["figure"] == figure)
        return f["value"];
    ADD_FAILURE() << figure << " is missing";
    return -1.0;
  }
};

const char* const kAll =
    "--picks s/horizon.xyz --fault s/fault_1.ts --truth s/truth.ply --cutoffs "
    "s/cutoff_fault_1_footwall.pol s/cutoff_fault_1_hangingwall.pol --sigma 2 ";

TEST_F(Evaluate, TheTruthKeepsEveryLimit) {
  synthesize("--kind reverse --origin 461000,5931000,1700 --z-positive down");
  const Json r = report(std::string("s/truth.ply --check --z-positive down ") + kAll);
  EXPECT_EQ(r["figures"].size(), 15U);
  for (const Json& figure : r["figures"])
    EXPECT_TRUE(figure["ok"]) << figure;
  EXPECT_EQ(r["truth"]["pieces"], 2);
  EXPECT_NEAR(r["approximation_error"]["all_picks"]["rms"], 2.0, 0.15); // the noise
  EXPECT_EQ(r["z_positive"], "down");
  EXPECT_EQ(r["cutoff_lines"].size(), 2U);
  EXPECT_EQ(r["faults"][0]["name"], "fault_1");
  EXPECT_EQ(r["flipped"]["facing_down"], 0);
}

TEST_F(Evaluate, TellsDistancesInSigmaAndInUnits) {
  synthesize("--kind unfaulted");
  TriangleMesh raised = readMesh(path("s/truth.ply"));
  for (Vector3& v : raised.vertices)
    v.z() += 3.0;
  writeMesh(path("raised.ply"), raised);
  EXPECT_NEAR(value(report("raised.ply --truth s/truth.ply --sigma 2"), "surface_to_truth_far"),
              1.5, 0.02);
  const Json in_units = report("raised.ply --truth s/truth.ply");
  EXPECT_NEAR(value(in_units, "surface_to_truth_far"), 3.0, 0.04);
  EXPECT_FALSE(in_units.contains("bridging_triangles"));
  EXPECT_FALSE(in_units.contains("approximation_error"));
  EXPECT_NEAR(value(report("raised.ply --truth s/truth.ply --z-scale 2"), "surface_to_truth_far"),
              6.0, 0.2);
}

TEST_F(Evaluate, TruthTheOtherWayUpIsTurnedOver) {
  synthesize("--kind normal --origin 0,0,1000 --z-positive down"); // .ts files say so, .ply cannot
  const test::Outcome outcome =
      run("evaluate",
          "s/truth_block_1.ts --truth s/truth_block_1.ts --fault s/fault_1.ts --report r.json");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.errors, "");
  EXPECT_EQ(Json::parse(content("r.json"))["z_positive"], "down");
  const test::Outcome turned = run("evaluate", "s/truth.ply --truth s/truth_block_1.ts");
  EXPECT_THAT(turned.errors, HasSubstr("s/truth_block_1.ts has its z the other way up"));
}

TEST_F(Evaluate, CheckFailsOnABridgeAndOnBadTopology) {
  synthesize("--kind normal");
  // Without a truth of its own, the truth of the unfaulted horizon bridges the fault.
  ASSERT_EQ(run("synthesize", "--quiet --output u --picks 2000 --kind unfaulted").code, 0);
  EXPECT_EQ(run("evaluate", "u/truth.ply --fault s/fault_1.ts").code, 0);
  const test::Outcome bridged = run("evaluate", "u/truth.ply --fault s/fault_1.ts --check");
  EXPECT_EQ(bridged.code, 1);
  EXPECT_THAT(bridged.errors, HasSubstr("bridging triangles"));
  TriangleMesh twice = readMesh(path("s/truth.ply"));
  twice.triangles.push_back(twice.triangles[5]);
  writeMesh(path("twice.obj"), twice);
  EXPECT_EQ(run("evaluate", "twice.obj").code, 0);
  const test::Outcome bad = run("evaluate", "twice.obj --check --quiet");
  EXPECT_EQ(bad.code, 1);
  EXPECT_EQ(bad.output, "");
  EXPECT_THAT(bad.errors, HasSubstr("topology is not ok"));
  EXPECT_EQ(run("evaluate", "s/truth.ply --fault s/fault_1.ts --check").code, 0);
}

TEST_F(Evaluate, EveryNumberOfThreadsGivesTheSameReport) {
  synthesize("--kind branch");
  const std::string arguments = "s/truth.ply --picks s/horizon.xyz --fault s/fault_1.pol "
                                "s/fault_2.ts --truth s/truth_block_*.ts ";
  const Json one = report(arguments + "--threads 1");
  EXPECT_EQ(one, report(arguments + "--threads 4"));
  EXPECT_EQ(one["truth"]["pieces"], 3);
}

TEST_F(Evaluate, WrongUseNamesTheFileAndWritesNothing) {
  synthesize("--kind normal");
  write("empty.ply", "");
  write("prose.ply", "Call me Ishmael.\n");
  write(
      "points.ply",
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float "
      "z\nelement face 0\nproperty list uchar int vertex_indices\nend_header\n1 2 3\n");
  const std::set<std::string> before = names();
  const std::vector<std::tuple<std::string, int, std::string>> cases = {
      {"", 2, "MESH"},
      {"s/truth.ply s/truth.ply", 2, "s/truth.ply"},
      {"s/truth.ply --pick s/horizon.xyz", 2, "did you mean --picks?"},
      {"s/truth.ply --zone-width 0", 2, "--zone-width"},
      {"s/truth.ply --samples many", 2, "--samples"},
      {"missing.ply", 1, "missing.ply"},
      {"empty.ply", 1, "empty.ply"},
      {"prose.ply", 1, "prose.ply"},
      {"points.ply", 1, "points.ply"},
      {"s/horizon.xyz", 1, "s/horizon.xyz"},
      {"s/truth.ply --picks missing.xyz", 1, "missing.xyz"},
      {"s/truth.ply --fault prose.ply", 1, "prose.ply"},
      {"s/truth.ply --truth empty.ply", 1, "empty.ply"},
      {"s/truth.ply --cutoffs s/fault_1.ts", 1, "s/fault_1.ts"},
      {"s/truth.ply --report no/r.json", 4, "no/r.json"},
      {"s/truth.ply --report s", 4, "s: "},
  };
  for (const auto& [arguments, code, words] : cases) {
    const test::Outcome outcome = run("evaluate", arguments);
    EXPECT_EQ(outcome.code, code) << arguments << "\n" << outcome.errors;
    EXPECT_THAT(outcome.errors, HasSubstr("graben_evaluate: error: ")) << arguments;
    EXPECT_THAT(outcome.errors, HasSubstr(words)) << arguments;
    EXPECT_EQ(outcome.output, "") << arguments;
  }
  EXPECT_EQ(names(), before);
}

} // namespace
} // namespace graben
