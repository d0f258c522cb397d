#include "tools/model/model_folder.h"

#include <cmath>
#include <regex>

namespace graben {
namespace {

using test::Outcome;
using ModelTool = test::ModelToolTest;

const std::string kHorizons = "--horizon A=sample/horizon.xyz B=sample/lower.xyz";

TEST_F(ModelTool, MakesClosedBlocksOfAFaultedStack) {
  makeStack("--kind normal --picks 4000 --noise 1", 200.0);
  const Outcome outcome = run("model", kHorizons + " --fault sample/fault_1.ts --inset 200 --results model --output alone.msh");
  ASSERT_EQ(outcome.code, 0) << outcome.errors;
  EXPECT_NE(outcome.output.find("model      6 blocks"), std::string::npos) << outcome.output;
  const SealedMesh mesh = closedModel("model");
  ASSERT_EQ(mesh.blocks.size(), 6U);
  double layer = 0.0;
  for (const SealedBlock& block : mesh.blocks)
    layer += block.layer == 1 ? block.volume : 0.0;
  const double heave = 100.0 * 0.85 / std::tan(60.0 * 3.14159265 / 180.0); // what the fault takes of the layer's width, on the mean
  EXPECT_NEAR(layer, 5600.0 * (5600.0 - heave) * 200.0, 0.003 * 5600.0 * 5600.0 * 200.0);
  for (const char* name : {"contacts.csv", "report.json", "model.ml", "model.geo", "model.vtm", "horizons", "faults", "patches.csv"})
    EXPECT_EQ(names("model").count(name), 1U) << name;
  EXPECT_EQ(content("model/model.msh"), content("alone.msh"));
}

TEST_F(ModelTool, IsTheSameForEveryNumberOfThreadsAndInUtm) {
  makeStack("--kind tip --picks 3000 --noise 1", 200.0);
  const std::string rest = " --fault sample/fault_1.ts --inset 200 --size 250 --quiet --results ";
  ASSERT_EQ(run("model", kHorizons + rest + "one --threads 1").code, 0);
  ASSERT_EQ(run("model", kHorizons + rest + "three --threads 3").code, 0);
  EXPECT_EQ(content("one/model.msh"), content("three/model.msh"));
  EXPECT_EQ(content("one/blocks.csv"), content("three/blocks.csv"));
  EXPECT_EQ(closedModel("one").blocks.size(), 3U) << "layers are whole round the tip";
}

TEST_F(ModelTool, DepthsStayDepths) {
  makeStack("--kind normal --picks 3000 --origin 461000,5931000,1700 --z-positive down", -150.0);
  const std::string command = kHorizons + " --fault sample/fault_1.ts --z-positive down --inset 200 --top 1000 --base 2500 --results ";
  ASSERT_EQ(run("model", command + "short").code, 0);
  EXPECT_EQ(closedModel("short").blocks.size(), 4U) << "the fault ends within the layers above and below";
  const Outcome outcome = run("model", command + "model --extend-faults box");
  ASSERT_EQ(outcome.code, 0) << outcome.errors;
  const SealedMesh mesh = closedModel("model");
  EXPECT_EQ(mesh.blocks.size(), 6U);
  double low = 1e9, high = -1e9, whole = 0.0;
  for (const Vector3& p : mesh.vertices) {
    low = std::min(low, p.z());
    high = std::max(high, p.z());
  }
  for (const SealedBlock& block : mesh.blocks)
    whole += block.volume;
  EXPECT_DOUBLE_EQ(low, 1000.0);
  EXPECT_DOUBLE_EQ(high, 2500.0);
  EXPECT_NEAR(whole, 1500.0 * 5600.0 * 5600.0, 0.01 * 1500.0 * 5600.0 * 5600.0);
}

TEST_F(ModelTool, IsCutToAPolygonUnderATopography) {
  makeStack("--kind normal --picks 3000 --origin 461000,5931000,0", 200.0);
  write("area.pol", "459000 5929000 0\n463000 5929400 0\n462500 5933000 0\n459200 5932500 0\n459000 5929000 0\n999 999 999\n");
  std::string ground;
  for (int x = 458000; x <= 464000; x += 100)
    for (int y = 5928000; y <= 5934000; y += 100)
      ground += std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(300.0 + 0.02 * (x - 461000)) + "\n";
  write("ground.xyz", ground);
  const Outcome outcome = run("model", kHorizons + " --fault sample/fault_1.ts --outline area.pol --top ground.xyz --base -700 --wall-size 900 --size 250 "
                                                   "--fill 500 --extend-faults box --results model");
  ASSERT_EQ(outcome.code, 0) << outcome.errors;
  const SealedMesh mesh = closedModel("model");
  EXPECT_EQ(mesh.blocks.size(), 6U);
  double volume = 0.0;
  for (const SealedBlock& block : mesh.blocks)
    volume += block.volume;
  const double area = 0.5 * ((4000.0 * 4000.0 - 3500.0 * 400.0) + (3500.0 * 3500.0 - 200.0 * 4000.0));
  EXPECT_NEAR(volume, 1000.0 * area, 0.01 * 1000.0 * area);
  for (const char* name : {"allan_1_fault_1.png", "allan_1_fault_1.svg"})
    EXPECT_EQ(names("model/faults").count(name), 1U) << name;
  EXPECT_EQ(run("model", kHorizons + " --outline nowhere.pol --results m").code, 2);
  EXPECT_EQ(run("model", kHorizons + " --top nowhere.xyz --results m").code, 2);
}

TEST_F(ModelTool, RefusesWhatIsNoStack) {
  makeStack("--kind normal --picks 2000", 200.0);
  const auto refused = [&](const std::string& arguments, const std::string& why, int code) {
    const Outcome outcome = run("model", arguments);
    EXPECT_EQ(outcome.code, code) << arguments;
    EXPECT_NE(outcome.errors.find(why), std::string::npos) << outcome.errors;
    EXPECT_EQ(std::count(outcome.errors.begin(), outcome.errors.end(), '\n'), 1) << outcome.errors;
  };
  refused("--horizon B=sample/lower.xyz A=sample/horizon.xyz --fault sample/fault_1.ts --results m", "horizon A lies above B by up to", 1);
  refused("--results m", "--horizon NAME=PICKS is missing", 2);
  refused(kHorizons, "--results DIR or --output FILE is missing", 2);
  refused(kHorizons + " --results m --outline box:1,2,3", "is not box:X0,Y0,X1,Y1", 2);
  refused(kHorizons + " --results m --outline box:90000,90000,99000,99000", "lies beside the picks", 1);
  refused(kHorizons + " --results m --inset 3100", "nothing is left", 1);
  refused(kHorizons + " --results m --top -5000 --base 0", "its top must lie above its base", 1);
  refused("--horizon A=sample/horizon.xyz A=sample/lower.xyz --results m", "two horizons are called A", 1);
  refused(kHorizons + " --output m.ply", "must be .msh, .ml or .vtm", 2);
  EXPECT_EQ(names().count("m"), 0U) << "nothing is left half-written";
}

TEST_F(ModelTool, SectionsTileTheModelAndReadThrows) {
  makeStack("--kind normal --picks 4000 --noise 1 --throw 120 --throw-variation 0", 200.0);
  ASSERT_EQ(run("model", kHorizons + " --fault sample/fault_1.ts --inset 200 --top 500 --base -700 --results model --quiet").code, 0);
  const Outcome outcome = run("section", "model --line=-2500,100,2500,-200 --line=-2000,-2000,0,500,2500,0 --output sections --format svg,dxf,vtp,csv "
                                         "--picks sample/horizon.xyz");
  ASSERT_EQ(outcome.code, 0) << outcome.errors;
  double area = 0.0;
  std::istringstream rows(content("sections/section_1.csv"));
  std::string row;
  std::getline(rows, row);
  while (std::getline(rows, row))
    area += std::stod(row.substr(row.rfind(',') + 1));
  EXPECT_NEAR(area, std::hypot(5000.0, 300.0) * 1200.0, 1e-3);
  std::smatch found;
  ASSERT_TRUE(std::regex_search(outcome.output, found, std::regex("A at fault_1: throw ([-0-9.]+) in the section, ([-0-9.]+) along dip"))) << outcome.output;
  EXPECT_NEAR(std::stod(found[2]), 120.0, 12.0);
  EXPECT_EQ(names("sections"), (std::set<std::string>{"section_1.csv", "section_1.dxf", "section_1.svg", "section_1.vtp", "section_1_throws.csv",
                                                      "section_2.csv", "section_2.dxf", "section_2.svg", "section_2.vtp", "section_2_throws.csv"}));
  EXPECT_EQ(content("sections/section_1.svg").substr(0, 5), "<?xml");
  EXPECT_EQ(run("section", "sample --line 0,0,1,1 --output s").code, 1);
  EXPECT_EQ(run("section", "model --line 0,0,1 --output s").code, 2);
  EXPECT_EQ(run("section", "model --line 90000,0,90001,5 --output s").code, 1);
}

} // namespace
} // namespace graben
