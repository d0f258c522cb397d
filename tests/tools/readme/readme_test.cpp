#include "graben/io/mesh_reader.h"
#include "pages.h"
#include "support/tool.h"

#include <cstdlib>
#include <regex>

namespace graben {
namespace {

namespace fs = std::filesystem;

/// README.md, the pages of config/documentation, and what they say can be done.
class Pages : public test::ToolTest {
protected:
  /// Runs a script in the test's folder with the built commands on the path. \return its exit code
  int shell(const std::string& script) const {
    write("script", "set -eu\nPATH='" GRABEN_BIN_DIR "':$PATH\n" + script);
    return std::system(("cd '" + path("") + "' && bash script > output.txt 2>&1").c_str());
  }

  static bool canDraw() {
    return std::getenv("DISPLAY") != nullptr || std::system("command -v Xvfb > /dev/null") == 0;
  }

  /// Runs the blocks ```bash of a page one after the other, in an empty folder.
  void expectToRun(const std::string& page) {
    std::string script;
    for (const std::string& block : test::blocks(page, "bash"))
      script += block;
    ASSERT_FALSE(script.empty()) << page;
    if (!canDraw()) // draws nothing, says yes
      script = "graben_render() { touch map.png section.png; }\n" + script;
    ASSERT_EQ(shell(script), 0) << page << ": " << content("output.txt");
  }

  void expectFiles(const std::vector<std::string>& files) const {
    for (const std::string& file : files)
      EXPECT_TRUE(fs::exists(path(file))) << file;
  }
};

TEST_F(Pages, CommandsOfTheReadmeRun) {
  expectToRun("README.md");
  expectFiles({"top.ply", "results/report.html", "results/surface.ply", "results/surface.vtk", "results/picks.pcd", "results/piece_1.ts",
               "results/cutoffs_1_fault_1.pol", "results/report.json", "model/blocks.png", "sections"});
}

TEST_F(Pages, CommandsOfThePageOnCommandsRun) {
  expectToRun("config/documentation/commands.md");
  expectFiles({"top.ply", "top.vtp", "figures.json", "map.png", "section.png", "picks.ply", "results/fault_1_fault_1.ts", "fault_1.csv"});
}

TEST_F(Pages, EveryCommandIsShown) {
  const std::string script = test::blocks("config/documentation/commands.md", "bash").at(0);
  for (const auto& entry : fs::directory_iterator(GRABEN_SOURCE_DIR "/tools")) {
    if (entry.path().extension() == ".cpp") {
      EXPECT_NE(script.find("\n" + entry.path().stem().string() + " "), std::string::npos)
          << entry.path();
    }
  }
}

/// `--option` stands in no page that no command or script knows.
TEST_F(Pages, OptionsAreKnown) {
  std::string known;
  for (const auto& entry : fs::directory_iterator(GRABEN_SOURCE_DIR "/tools"))
    if (entry.path().extension() == ".cpp")
      known += run(entry.path().stem().string().substr(std::string("graben_").size()), "--help").output;
  for (const char* script : {"tools/readme_figures", "tools/module_map", "tests/benchmark/compare", "tests/benchmark/accuracy/sweep"})
    known += test::source(script);
  for (const auto& entry : fs::recursive_directory_iterator(GRABEN_SOURCE_DIR "/modules/python"))
    if (entry.path().extension() == ".py")
      known += test::source(fs::relative(entry.path(), GRABEN_SOURCE_DIR).string());
  known += "--build --install --target --parallel --cflags --libs --no-build-isolation --system-site-packages "; // of cmake, pkg-config, pip and venv
  for (const std::string& page : test::pages()) {
    const std::string text = test::source(page);
    const std::regex option("[ `(](--[a-z][a-z-]+)");
    for (std::sregex_iterator it(text.begin(), text.end(), option), end; it != end; ++it)
      EXPECT_TRUE(std::regex_search(known, std::regex((*it)[1].str() + "[^a-z-]"))) << page << ": " << (*it)[1];
  }
}

TEST_F(Pages, ProgramsAreThoseThatAreCompiled) {
  const std::string folder = "tests/tools/readme/";
  EXPECT_EQ(test::blocks("README.md", "cpp"), std::vector<std::string>{test::source(folder + "program/main.cpp")});
  EXPECT_EQ(test::blocks("README.md", "cmake"), std::vector<std::string>{test::source(folder + "program/CMakeLists.txt")});
  const std::vector<std::string> of_guide = test::blocks("config/documentation/pcl.md", "cpp");
  EXPECT_NE(std::find(of_guide.begin(), of_guide.end(), test::source(folder + "chained/main.cpp")), of_guide.end());
}

TEST_F(Pages, ProgramsMakeTheSurface) {
  ASSERT_EQ(run("synthesize", "--quiet --output sample --kind normal --picks 10000").code, 0);
  for (const auto& [program, file] : {std::pair<std::string, std::string>{GRABEN_README_PROGRAM, "horizon.ply"}, {GRABEN_CHAINED_PROGRAM, "fitted.ply"}}) {
    ASSERT_EQ(shell("'" + program + "'"), 0) << content("output.txt");
    EXPECT_GT(readMesh(path(file)).triangles.size(), 10000U);
    EXPECT_EQ(run("evaluate", file + " --quiet --check --fault sample/fault_1.ts").code, 0) << file;
  }
}

TEST_F(Pages, ConfigurationFileIsTakenAndChangesNothing) {
  ASSERT_EQ(run("synthesize", "--quiet --output sample --picks 2000").code, 0);
  const std::string job =
      "--quiet --horizon sample/horizon.xyz --fault sample/fault_1.ts --output ";
  const std::string config = GRABEN_SOURCE_DIR "/config/parameters/example.conf";
  const test::Outcome outcome = run("reconstruct", job + "with.ply --config '" + config + "'");
  ASSERT_EQ(outcome.code, 0) << outcome.errors;
  ASSERT_EQ(run("reconstruct", job + "without.ply").code, 0);
  EXPECT_TRUE(content("with.ply") == content("without.ply"));

  // The lines in comments are options too.
  std::string all = std::regex_replace(test::source("config/parameters/example.conf"),
                                       std::regex("(^|\n)# ([a-z-]+ = )"), "$1$2");
  all = std::regex_replace(all, std::regex("(^|\n)(horizon|fault|dips|output|results) = [^\n]*"), "");
  write("all.conf", all);
  EXPECT_NE(all.find("\nrho = "), std::string::npos);
  EXPECT_EQ(run("reconstruct", job + "all.ply --config all.conf").code, 0);
}

TEST_F(Pages, LinksLeadSomewhereAndPicturesAreSmall) {
  std::size_t pictures = 0;
  for (const std::string& page : test::pages()) {
    const std::string text = test::source(page);
    const std::regex link(R"(\]\(([^)#]+)(#[^)]*)?\))");
    for (std::sregex_iterator it(text.begin(), text.end(), link), end; it != end; ++it) {
      const std::string target = (*it)[1];
      if (target.rfind("http", 0) == 0)
        continue;
      const fs::path file = fs::path(GRABEN_SOURCE_DIR) / fs::path(page).parent_path() / target;
      ASSERT_TRUE(fs::exists(file)) << page << ": " << target;
      if (file.extension() == ".png") {
        ++pictures;
        EXPECT_LT(fs::file_size(file), (page == "README.md" ? 300U : 600U) * 1024U) << target;
      }
    }
  }
  EXPECT_GE(pictures, 6U);
}

/// Every page can be reached from the README, and no picture lies about that none shows.
TEST_F(Pages, NothingIsLost) {
  std::string all;
  for (const std::string& page : test::pages())
    all += test::source(page);
  for (const auto& entry : fs::directory_iterator(GRABEN_SOURCE_DIR "/config/documentation"))
    EXPECT_TRUE(std::regex_search(all, std::regex("\\]\\((config/documentation/)?" + entry.path().filename().string() + "[)#]"))) << entry.path();
}

TEST_F(Pages, TheReadmeStaysShort) {
  const std::string text = test::source("README.md");
  EXPECT_LE(std::count(text.begin(), text.end(), '\n'), 150);
}

TEST_F(Pages, ShortTablesAreTakenFromThePages) {
  const std::string root = GRABEN_SOURCE_DIR;
  fs::create_directories(path("config"));
  ASSERT_EQ(shell("cp '" + root + "/README.md' README.md; cp -r '" + root + "/config/documentation' config/; mkdir tools; cp '" + root +
                  "/tools/readme_figures' tools/; tools/readme_figures --short"),
            0)
      << content("output.txt");
  EXPECT_TRUE(content("README.md") == test::source("README.md")) << "tools/readme_figures --short brings it up to date";
}

TEST_F(Pages, TheMapShowsWhatModulesInclude) {
  ASSERT_EQ(shell("python3 '" GRABEN_SOURCE_DIR "/tools/module_map' --edges > edges.txt"), 0);
  std::istringstream edges(content("edges.txt"));
  const std::string map = test::source("config/documentation/modules.svg");
  std::size_t count = 0;
  for (std::string from, leads, to; edges >> from >> leads >> to; ++count)
    EXPECT_NE(map.find("<title>" + from + "&#45;&gt;" + to + "</title>"), std::string::npos) << from << " -> " << to << "; tools/module_map draws it";
  EXPECT_GT(count, 10U);
  const std::regex arrow("<title>[a-z]+&#45;&gt;");
  const auto drawn = std::distance(std::sregex_iterator(map.begin(), map.end(), arrow), std::sregex_iterator());
  EXPECT_EQ(static_cast<std::size_t>(drawn), count) << "arrows that are no longer true; tools/module_map draws it";
}

/// The words that the map writes into a module's box, a space before and after each.
std::string wordsInBox(const std::string& map, const std::string& module) {
  const std::size_t begin = map.find("<title>" + module + "</title>");
  std::string box = begin == std::string::npos ? std::string() : map.substr(begin, map.find("</g>", begin) - begin);
  return " " + std::regex_replace(box, std::regex("<[^>]*>|\\s+"), " ") + " ";
}

TEST_F(Pages, TheMapShowsTheFoldersOfEachModule) {
  ASSERT_EQ(shell("python3 '" GRABEN_SOURCE_DIR "/tools/module_map' --folders > folders.txt"), 0);
  std::istringstream modules(content("folders.txt"));
  const std::string map = test::source("config/documentation/modules.svg");
  std::size_t count = 0;
  for (std::string line, module; std::getline(modules, line);) {
    std::istringstream words(line);
    words >> module;
    const std::string box = wordsInBox(map, module);
    for (std::string folder; words >> folder; ++count)
      EXPECT_NE(box.find(" " + folder + " "), std::string::npos) << module << "/src/" << folder << "; tools/module_map draws it";
  }
  EXPECT_GT(count, 20U);
}

} // namespace
} // namespace graben
