#include "graben/io/mesh_reader.h"
#include "support/tool.h"

#include <algorithm>
#include <cstdlib>
#include <regex>
#include <vector>

namespace graben {
namespace {

namespace fs = std::filesystem;

/// README.md and the files it names.
class Readme : public test::ToolTest {
protected:
  static std::string source(const std::string& file) {
    std::ifstream in(fs::path(GRABEN_SOURCE_DIR) / file, std::ios::binary);
    EXPECT_TRUE(in) << file;
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
  }

  /// The blocks fenced with ```language, in order.
  static std::vector<std::string> blocks(const std::string& language) {
    std::vector<std::string> found;
    std::istringstream in(source("README.md"));
    bool inside = false;
    for (std::string line; std::getline(in, line);) {
      if (!inside && line == "```" + language) {
        inside = true;
        found.emplace_back();
      } else if (inside && line == "```") {
        inside = false;
      } else if (inside) {
        found.back() += line + "\n";
      }
    }
    return found;
  }

  /// Runs a script in the test's folder with the built commands on the path. \return its exit code
  int shell(const std::string& script) const {
    write("script", "set -eu\nPATH='" GRABEN_BIN_DIR "':$PATH\n" + script);
    return std::system(("cd '" + path("") + "' && bash script > output.txt 2>&1").c_str());
  }

  static bool canDraw() {
    return std::getenv("DISPLAY") != nullptr || std::system("command -v Xvfb > /dev/null") == 0;
  }
};

TEST_F(Readme, CommandsRunAsPrinted) {
  const std::vector<std::string> scripts = blocks("bash");
  ASSERT_EQ(scripts.size(), 1U);
  std::string script = scripts[0];
  if (!canDraw()) // draws nothing, says yes
    script = "graben_render() { touch map.png section.png; }\n" + script;
  ASSERT_EQ(shell(script), 0) << content("output.txt");
  for (const char* file :
       {"top.ply", "top.vtp", "figures.json", "map.png", "section.png", "picks.ply"})
    EXPECT_TRUE(fs::exists(path(file))) << file;
  for (const char* file : {"surface.ply", "surface.vtk", "piece_1.ts", "fault_1_fault_1.ts",
                           "cutoffs_1_fault_1.pol", "picks.pcd", "report.json"}) {
    EXPECT_TRUE(fs::exists(path("results/" + std::string(file)))) << file;
  }
}

TEST_F(Readme, EveryCommandIsShown) {
  const std::string script = blocks("bash").at(0);
  for (const auto& entry : fs::directory_iterator(GRABEN_SOURCE_DIR "/tools")) {
    if (entry.path().extension() == ".cpp") {
      EXPECT_NE(script.find("\n" + entry.path().stem().string() + " "), std::string::npos)
          << entry.path();
    }
  }
}

TEST_F(Readme, ProgramIsTheOneThatIsCompiled) {
  EXPECT_EQ(blocks("cpp"), std::vector<std::string>{source("tests/tools/readme/program/main.cpp")});
  EXPECT_EQ(blocks("cmake"),
            std::vector<std::string>{source("tests/tools/readme/program/CMakeLists.txt")});
}

TEST_F(Readme, ProgramMakesTheSurface) {
  ASSERT_EQ(run("synthesize", "--quiet --output sample --kind normal --picks 10000 --noise 0").code,
            0);
  ASSERT_EQ(shell("'" GRABEN_README_PROGRAM "'"), 0) << content("output.txt");
  const TriangleMesh mesh = readMesh(path("fitted.ply"));
  EXPECT_GT(mesh.triangles.size(), 10000U);
  EXPECT_EQ(run("evaluate", "fitted.ply --quiet --check --fault sample/fault_1.ts").code, 0);
}

TEST_F(Readme, ConfigurationFileIsTakenAndChangesNothing) {
  ASSERT_EQ(run("synthesize", "--quiet --output sample --picks 2000").code, 0);
  const std::string job =
      "--quiet --horizon sample/horizon.xyz --fault sample/fault_1.ts --output ";
  const std::string config = GRABEN_SOURCE_DIR "/config/parameters/example.conf";
  const test::Outcome outcome = run("reconstruct", job + "with.ply --config '" + config + "'");
  ASSERT_EQ(outcome.code, 0) << outcome.errors;
  ASSERT_EQ(run("reconstruct", job + "without.ply").code, 0);
  EXPECT_TRUE(content("with.ply") == content("without.ply"));

  // The lines in comments are options too.
  std::string all = std::regex_replace(source("config/parameters/example.conf"),
                                       std::regex("(^|\n)# ([a-z-]+ = )"), "$1$2");
  all = std::regex_replace(all, std::regex("(^|\n)(horizon|fault|dips|output|results) = [^\n]*"), "");
  write("all.conf", all);
  EXPECT_NE(all.find("\nrho = "), std::string::npos);
  EXPECT_EQ(run("reconstruct", job + "all.ply --config all.conf").code, 0);
}

TEST_F(Readme, LinksLeadSomewhereAndPicturesAreSmall) {
  const std::string text = source("README.md");
  const std::regex link(R"(\]\(([^)]+)\))");
  std::size_t pictures = 0;
  for (std::sregex_iterator it(text.begin(), text.end(), link), end; it != end; ++it) {
    const std::string target = (*it)[1];
    if (target.rfind("http", 0) == 0)
      continue;
    const fs::path file = fs::path(GRABEN_SOURCE_DIR) / target;
    ASSERT_TRUE(fs::exists(file)) << target;
    if (file.extension() == ".png") {
      ++pictures;
      EXPECT_LT(fs::file_size(file), 300U * 1024U) << target;
    }
  }
  EXPECT_GE(pictures, 1U);
}

} // namespace
} // namespace graben
