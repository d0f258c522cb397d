#include "support/tool.h"

#include <gmock/gmock.h>

namespace graben {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

class ReconstructWrongUse : public test::ToolTest {
protected:
  /// A small flat horizon and a fault far away from it.
  void SetUp() override {
    ToolTest::SetUp();
    std::string rows;
    for (int i = 0; i < 20; ++i)
      for (int j = 0; j < 20; ++j)
        rows += std::to_string(10 * i + j % 3) + " " + std::to_string(10 * j + i % 3) + " " +
                std::to_string(100 + (i + j) % 2) + "\n";
    write("picks.xyz", rows);
    write("far.pol", "9000 0 0\n9000 0 300\n999 999 999\n9000 200 0\n9000 200 300\n999 999 999\n");
  }

  /// Expects an error with one line that says \a words, and a folder as it was.
  void expectError(const std::string& arguments, int code, const std::vector<std::string>& words) {
    const std::set<std::string> before = names();
    const test::Outcome outcome = run("reconstruct", arguments);
    EXPECT_EQ(outcome.code, code) << arguments << "\n" << outcome.errors;
    EXPECT_THAT(outcome.errors, HasSubstr("graben_reconstruct: error: ")) << arguments;
    EXPECT_EQ(std::count(outcome.errors.begin(), outcome.errors.end(), '\n'), 1) << outcome.errors;
    for (const std::string& word : words)
      EXPECT_THAT(outcome.errors, HasSubstr(word)) << arguments;
    EXPECT_EQ(names(), before) << arguments;
  }
};

TEST_F(ReconstructWrongUse, OfOptionsExitsWithTwo) {
  expectError("", 2, {"--output SURFACE is missing", "--help"});
  expectError("--output top.ply", 2, {"--horizon PICKS is missing"});
  expectError("--horizon picks.xyz", 2, {"--output SURFACE is missing"});
  expectError("--horizon picks.xyz --outptu top.ply", 2, {"--outptu", "did you mean --output?"});
  expectError("--horizon picks.xyz --output top.xyzzy", 2, {"top.xyzzy", ".ply", ".ts"});
  expectError("--horizon picks.xyz --output top", 2, {"top", ".ply"});
  expectError("--horizon picks.xyz --output top.ply --voxel-size nan", 2, {"--voxel-size", "nan"});
  expectError("--horizon picks.xyz --output top.ply --voxel-size -1", 2, {"--voxel-size", "-1"});
  expectError("--horizon picks.xyz --output top.ply --fit best", 2, {"--fit", "best", "normal"});
  expectError("picks.xyz --output top.ply", 2, {"picks.xyz"});
}

TEST_F(ReconstructWrongUse, OfInputFilesNamesTheFile) {
  write("empty.xyz", "");
  write("prose.xyz", "Call me Ishmael. Some years ago\nnever mind how long precisely\n");
  write("one.xyz", "1 2 3\n");
  write("same.xyz", "1 2 3\n1 2 3\n1 2 3\n1 2 3\n");
  write("nan.xyz", "nan nan nan\nnan nan nan\nnan nan nan\n");
  write("cut.pcd",
        "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH "
        "100\nHEIGHT 1\nPOINTS 100\nDATA binary\nabc");
  std::string line;
  for (int i = 0; i < 50; ++i)
    line += std::to_string(3 * i) + " " + std::to_string(6 * i) + " " + std::to_string(i) + "\n";
  write("line.xyz", line);
  std::filesystem::create_directory(path("folder"));
  const std::vector<std::string> files = {"missing.xyz", "empty.xyz", "prose.xyz",
                                          "one.xyz",     "same.xyz",  "nan.xyz",
                                          "line.xyz",    "cut.pcd",   "folder"};
  for (const std::string& file : files)
    expectError("--horizon " + file + " --output top.ply --results results", 1, {file});
  for (const char* file : {"missing.ts", "empty.xyz", "prose.xyz", "one.xyz", "folder"})
    expectError(std::string("--horizon picks.xyz --output top.ply --fault ") + file, 1, {file});
}

TEST_F(ReconstructWrongUse, OfOutputsIsFoundBeforeAnythingIsWritten) {
  std::filesystem::create_directory(path("taken.ply"));
  write("file", "mine");
  expectError("--horizon picks.xyz --output no/top.ply", 4, {"no/top.ply", "does not exist"});
  expectError("--horizon picks.xyz --output taken.ply", 4, {"taken.ply", "folder"});
  expectError("--horizon picks.xyz --output top.ply --report no/r.json", 4, {"no/r.json"});
  expectError("--horizon picks.xyz --output top.ply --report taken.ply", 4,
              {"taken.ply", "folder"});
  expectError("--horizon picks.xyz --output top.ply --results file", 4, {"file", "folder"});
  expectError("--horizon picks.xyz --output top.ply --results file/below", 4, {"file"});
  EXPECT_THAT(names("taken.ply"), IsEmpty());
  EXPECT_EQ(content("file"), "mine");
}

TEST_F(ReconstructWrongUse, OfAFullDiskLeavesTheFormerSurface) {
  write("top.ply", "former");
  // ulimit -f is in blocks of 512 bytes: enough for no surface
  const std::string command =
      "cd '" + path(".") +
      "' && trap '' XFSZ && ulimit -f 4 && '" GRABEN_BIN_DIR
      "/graben_reconstruct' --horizon picks.xyz --output top.ply 2>/dev/null";
  const int status = std::system(("bash -c \"" + command + "\"").c_str());
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 4);
  EXPECT_EQ(content("top.ply"), "former");
  EXPECT_EQ(names(), (std::set<std::string>{"far.pol", "picks.xyz", "top.ply"}));
}

TEST_F(ReconstructWrongUse, TooLittleMemoryForThePicturesIsSaidToo) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers take all addresses there are";
#endif
  bool done = false;
  for (int megabytes = 60; megabytes < 1500 && !done; megabytes += 10) {
    const std::string limit = "ulimit -v " + std::to_string(1000 * megabytes) + " &&";
    const test::Outcome outcome = run("reconstruct", "--horizon picks.xyz --output top.ply --results out --quiet --picture-formats png", limit);
    done = outcome.code == 0;
    if (done || outcome.errors.find("loading shared libraries") != std::string::npos) // before graben's first line
      continue;
    ASSERT_EQ(outcome.code, 1) << megabytes << " MB: " << outcome.errors;
    EXPECT_FALSE(outcome.errors.empty()) << megabytes << " MB";
  }
  EXPECT_TRUE(done);
}

TEST_F(ReconstructWrongUse, TooSmallAVoxelIsAnErrorNotAHang) {
  expectError("--horizon picks.xyz --output top.ply --voxel-size 1e-6", 1,
              {"picks.xyz", "voxel size"});
}

TEST_F(ReconstructWrongUse, TooLittleMemoryIsSaidBeforeTheWorkStarts) {
  expectError("--horizon picks.xyz --output top.ply --memory-limit 1e-5", 1, {"400 picks need", "raise the limit"});
  expectError("--horizon picks.xyz --output top.ply --voxel-size 0.01 --memory-limit 0.1", 1, {"voxel size of"});
  EXPECT_EQ(run("reconstruct", "--horizon picks.xyz --output top.ply --memory-limit 0 --quiet").code, 0);
}

TEST_F(ReconstructWrongUse, OfSkippedStepsListsThem) {
  expectError("--horizon picks.xyz --output top.ply --skip everything", 2, {"--skip", "everything", "zone-fit"});
}

TEST_F(ReconstructWrongUse, OfDipsNamesFileAndLine) {
  write("dips.csv", "x,y,z,dip,azimuth\n0,0,100,95,0\n");
  expectError("--horizon picks.xyz --dips dips.csv --output top.ply", 1, {"dips.csv:2"});
}

TEST_F(ReconstructWrongUse, AFaultThatTouchesNothingIsAWarning) {
  const test::Outcome outcome =
      run("reconstruct", "--horizon picks.xyz --fault far.pol --output top.ply --quiet");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.errors, HasSubstr("warning: Fault far does not touch the horizon"));
  EXPECT_EQ(outcome.output, "");
  ASSERT_EQ(run("reconstruct", "--horizon picks.xyz --output without.ply --quiet").code, 0);
  EXPECT_EQ(content("top.ply"), content("without.ply"));
}

TEST_F(ReconstructWrongUse, WhatIsOddAboutTheInputIsSaidBeforeAnError) {
  std::string picks = "X,Y,Z\n";
  for (int i = 0; i < 400; ++i)
    picks += std::to_string(50 * (i % 20)) + "," + std::to_string(50 * (i / 20)) + "," + std::to_string(-2.0 - 0.0001 * (i % 20)) + "\n";
  write("km.csv", picks);
  write("km.pol", "500 0 -1.7\n520 0 -2.3\n999 999 999\n500 500 -1.7\n520 500 -2.3\n999 999 999\n500 1000 -1.7\n520 1000 -2.3\n");
  const test::Outcome outcome = run("reconstruct", "--horizon km.csv --fault km.pol --output top.ply");
  EXPECT_THAT(outcome.errors, HasSubstr("warning: z spans"));
  EXPECT_THAT(outcome.errors, HasSubstr("--z-scale"));
}

TEST_F(ReconstructWrongUse, WindowsLineEndsAndCommasMakeNoDifference) {
  std::string windows = "x,y,z\r\n";
  for (const char c : content("picks.xyz"))
    windows += c == ' ' ? "," : c == '\n' ? "\r\n" : std::string(1, c);
  write("windows.csv", windows);
  ASSERT_EQ(run("reconstruct", "--horizon picks.xyz --output a.ply").code, 0);
  ASSERT_EQ(run("reconstruct", "--horizon windows.csv --output b.ply").code, 0);
  EXPECT_EQ(content("a.ply"), content("b.ply"));
}

TEST_F(ReconstructWrongUse, DuplicatePicksGiveASoundSurface) {
  std::string many;
  for (int i = 0; i < 200; ++i)
    many += content("picks.xyz");
  write("twice.xyz", many);
  EXPECT_THAT(run("reconstruct", "--horizon twice.xyz --output top.ply").errors, HasSubstr("79600 of 80000 picks lie exactly where another one is"));
  const test::Outcome outcome = run("reconstruct", "--horizon twice.xyz --output top.ply --quiet");
  EXPECT_EQ(outcome.code, 0) << outcome.errors;
  EXPECT_EQ(outcome.errors, "");
  EXPECT_EQ(run("evaluate", "top.ply --picks twice.xyz --check --quiet").code, 0);
}

TEST_F(ReconstructWrongUse, WhatTheSurfaceMustReachDecidesTheExitCode) {
  const std::string job = "reconstruct";
  EXPECT_EQ(run(job, "--horizon picks.xyz --output a.ply --quiet --require 'rms<1e6,topology_errors=0'").code, 0);
  const test::Outcome failed = run(job, "--horizon picks.xyz --output b.ply --quiet --require 'rms<1e6,pieces>7'");
  EXPECT_EQ(failed.code, 1);
  EXPECT_EQ(failed.errors, "graben_reconstruct: not good enough: pieces is 1, not above 7\n");
  EXPECT_EQ(content("a.ply"), content("b.ply"));
  const test::Outcome refused = run(job, "--horizon picks.xyz --output c.ply --require 'rmse<5'");
  EXPECT_EQ(refused.code, 2);
  EXPECT_THAT(refused.errors, HasSubstr("the report has no figure 'rmse'; it has rms, p95"));
  EXPECT_EQ(names().count("c.ply"), 0U);
}

TEST_F(ReconstructWrongUse, HelpAndVersionNeedNothing) {
  EXPECT_THAT(run("reconstruct", "--help").output, HasSubstr("--horizon PICKS"));
  EXPECT_EQ(run("reconstruct", "--version").code, 0);
}

} // namespace
} // namespace graben
