#include "support/tool.h"

#include <gmock/gmock.h>
#include <sys/stat.h>

namespace graben {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// Outputs of all commands that would take the place of something else. The sample: horizon.xyz, fault_1.ts, truth.ply in s.
class Outputs : public test::ToolTest {
protected:
  void SetUp() override {
    ToolTest::SetUp();
    ASSERT_EQ(run("synthesize", "--output s --kind normal --picks 500 --format ply --quiet").code, 0);
    write("s.conf", "voxel-size = 200\n");
    fs::create_symlink("s/horizon.ply", path("link.ply"));
    fs::create_hard_link(path("s/horizon.ply"), path("hard.ply"));
    fs::create_directory_symlink("s", path("other"));
    before_ = all();
  }

  /// Every file below the test's folder with its content.
  std::map<std::string, std::string> all() const {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(path("")))
      files[entry.path().string()] = entry.is_regular_file() ? content(entry.path().string()) : "";
    return files;
  }

  void expectRefused(const std::string& tool, const std::string& arguments, int code, const std::string& words) {
    const test::Outcome outcome = run(tool, arguments);
    EXPECT_EQ(outcome.code, code) << tool << " " << arguments << "\n" << outcome.errors;
    EXPECT_THAT(outcome.errors, HasSubstr(words)) << tool << " " << arguments;
    EXPECT_TRUE(all() == before_) << tool << " " << arguments;
  }

  std::map<std::string, std::string> before_;
};

TEST_F(Outputs, AreNeverAnInput) {
  const std::string job = "--horizon s/horizon.ply --fault s/fault_1.ts --config s.conf ";
  for (const char* output : {"s/horizon.ply", "./s/../s/horizon.ply", "link.ply", "hard.ply", "other/horizon.ply"})
    expectRefused("reconstruct", job + "--output " + output, 2, "is the same file as --horizon s/horizon.ply");
  expectRefused("reconstruct", job + "--output s/fault_1.ts", 2, "--fault s/fault_1.ts");
  expectRefused("reconstruct", job + "--output o.ply --report s.conf", 2, "--config s.conf");
  expectRefused("reconstruct", "--horizon s/horizon.ply --dips d.csv s/fault_1.ts --output s/fault_1.ts", 2, "--dips s/fault_1.ts");
  expectRefused("reconstruct", "--horizon /dev/stdin --output s/horizon.ply < s/horizon.ply", 2, "--horizon /dev/stdin");
  expectRefused("evaluate", "s/truth.ply --report s/truth.ply", 2, "MESH s/truth.ply");
  expectRefused("evaluate", "s/truth.ply --picks s/horizon.ply --report link.ply", 2, "--picks s/horizon.ply");
  for (const char* option : {"fault", "truth", "cutoffs"})
    expectRefused("evaluate", "s/truth.ply --" + std::string(option) + " s/fault_1.pol --report s/fault_1.pol", 2, "--" + std::string(option));
  expectRefused("render", "s/truth.ply --output s/truth.ply", 2, "MESH s/truth.ply");
  expectRefused("render", "s/truth.ply --picks s/horizon.ply --output hard.ply", 2, "--picks s/horizon.ply");
  expectRefused("synthesize", "--config s/README.txt --output s", 2, "README.txt");
}

TEST_F(Outputs, AreNeverEachOther) {
  fs::create_symlink("new.ply", path("dangling.ply"));
  fs::create_directory(path("r"));
  before_ = all();
  const std::string job = "--horizon s/horizon.ply ";
  expectRefused("reconstruct", job + "--output o.ply --report o.ply", 2, "--output o.ply and --report o.ply are the same file");
  expectRefused("reconstruct", job + "--output s/o.ply --report other/../s/./o.ply", 2, "are the same file");
  expectRefused("reconstruct", job + "--output new.ply --report dangling.ply", 2, "are the same file");
  expectRefused("reconstruct", job + "--results r --output r/surface.ply", 2, "surface.ply in it is --output");
  expectRefused("reconstruct", job + "--results r --report r/report.json", 2, "report.json in it is --report");
}

TEST_F(Outputs, OfTheResultsFolderReplaceNothingOfOthers) {
  for (const char* name : {"surface.ply", "report.json", "graben_reconstruct.manifest", "piece_1.ts", "fault_1_fault_1.ts", "throw_1_fault_1.csv"}) {
    fs::remove_all(path("r"));
    fs::create_directory(path("r"));
    write(std::string("r/") + name, "mine");
    before_ = all();
    expectRefused("reconstruct", "--horizon s/horizon.ply --fault s/fault_1.ts --results r --output o.ply", 2,
                  std::string(name) + " in it is not from an earlier run");
  }
  fs::remove_all(path("r"));
  ASSERT_EQ(run("reconstruct", "--horizon s/horizon.ply --fault s/fault_1.ts --results r --quiet", "DISPLAY= PATH=/nowhere").code, 0);
  before_ = all();
  expectRefused("reconstruct", "--horizon s/horizon.ply --fault r/fault_1_fault_1.ts --results r", 2, "fault_1_fault_1.ts in it is what --fault reads");
  expectRefused("reconstruct", "--horizon r/picks.pcd --results r", 2, "picks.pcd in it is what --horizon reads");
}

TEST_F(Outputs, OfTheResultsFolderLeaveTheUsersFiles) {
  const std::string job = "--horizon s/horizon.ply --fault s/fault_1.ts --quiet --results s";
  for (int i = 0; i < 2; ++i) {
    const test::Outcome outcome = run("reconstruct", job, "DISPLAY= PATH=/nowhere");
    ASSERT_EQ(outcome.code, 0) << outcome.errors;
    for (const auto& [file, text] : before_)
      EXPECT_TRUE(fs::is_directory(file) || all().at(file) == text) << file;
    for (const char* name : {"s/piece_77.ts", "s/fault_1_old.ts", "s/cutoffs_1.pol", "s/throw_of_mine.csv"}) {
      write(name, "mine");
      before_[path(name)] = "mine";
    }
  }
}

TEST_F(Outputs, FollowLinks) {
  fs::create_directory(path("below"));
  write("below/old.ply", "old");
  fs::create_symlink("below/old.ply", path("good.ply"));
  fs::create_symlink("below/new.ply", path("dangling.ply"));
  for (const std::string name : {"good", "dangling"}) {
    ASSERT_EQ(run("reconstruct", "--horizon s/horizon.ply --quiet --output " + name + ".ply").code, 0);
    EXPECT_TRUE(fs::is_symlink(path(name + ".ply")));
  }
  EXPECT_EQ(names("below"), (std::set<std::string>{"new.ply", "old.ply"}));
  EXPECT_EQ(content("below/new.ply"), content("below/old.ply"));
  EXPECT_GT(content("below/new.ply").size(), 1000U);
}

TEST_F(Outputs, ThatCannotBeWrittenAreFoundBeforeTheWork) {
  write("protected.ply", "mine");
  fs::permissions(path("protected.ply"), fs::perms::owner_read);
  before_ = all();
  // The input is not even looked for.
  expectRefused("reconstruct", "--horizon none.xyz --output protected.ply", 4, "write-protected");
  expectRefused("reconstruct", "--horizon none.xyz --output o.ply --report protected.ply", 4, "write-protected");
  expectRefused("reconstruct", "--horizon none.xyz --output none/o.ply", 4, "does not exist");
  expectRefused("reconstruct", "--horizon none.xyz --output /proc/o.ply", 4, "/proc");
  expectRefused("reconstruct", "--horizon none.xyz --results /proc/r", 4, "/proc");
  expectRefused("reconstruct", "--horizon none.xyz --results protected.ply/r", 4, "is a file");
  expectRefused("pcd2ply", "none.pcd protected.ply", 4, "write-protected");
  expectRefused("pcd2ply", "none.pcd none/o.ply", 4, "does not exist");
  expectRefused("evaluate", "none.ply --report none/r.json", 4, "does not exist");
  expectRefused("render", "none.ply --output none/p.png", 4, "does not exist");
  expectRefused("render", "none.ply --output s", 4, "folder");
  expectRefused("synthesize", "--output s.conf/d", 4, "is a file");
}

TEST_F(Outputs, ToAFullDeviceFail) {
  for (const char* extension : {"ply", "vtk", "vtp", "obj", "stl", "ts"}) {
    const std::string link = std::string("full.") + extension;
    fs::create_symlink("/dev/full", path(link));
    const test::Outcome outcome = run("reconstruct", "--horizon s/horizon.ply --quiet --output " + link);
    EXPECT_EQ(outcome.code, 4) << extension;
    EXPECT_THAT(outcome.errors, HasSubstr(link + ": cannot be written")) << extension;
    EXPECT_EQ(std::count(outcome.errors.begin(), outcome.errors.end(), '\n'), 1) << outcome.errors;
  }
  before_ = all();
  expectRefused("evaluate", "s/truth.ply --report /dev/full", 4, "/dev/full: cannot be written");
  expectRefused("render", "s/truth.ply --output /dev/full", 4, "/dev/full: cannot be written");
  expectRefused("reconstruct", "--horizon s/horizon.ply --output o.ply --help > /dev/full", 4, "standard output");
  struct stat status {};
  ASSERT_EQ(stat("/dev/full", &status), 0);
  EXPECT_TRUE(S_ISCHR(status.st_mode));
}

TEST_F(Outputs, ErrorsSayWhatStands) {
  write("o.ply", "former");
  ASSERT_EQ(run("reconstruct", "--horizon s/horizon.ply --results r --quiet", "DISPLAY= PATH=/nowhere").code, 0);
  const std::string former = content("r/report.json");
  const test::Outcome outcome = run("reconstruct", "--horizon s/horizon.ply --output o.ply --report /dev/full --results r --quiet", "DISPLAY= PATH=/nowhere");
  EXPECT_EQ(outcome.code, 4);
  EXPECT_THAT(outcome.errors, HasSubstr("; --output o.ply was written, --report /dev/full, --results r are as before"));
  EXPECT_GT(content("o.ply").size(), 1000U);
  EXPECT_EQ(content("r/report.json"), former);
  EXPECT_EQ(names("r").count("surface.ply"), 1U);
}

} // namespace
} // namespace graben
