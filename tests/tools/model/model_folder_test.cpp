#include "tools/model/model_folder.h"

#include <nlohmann/json.hpp>

#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <map>
#include <thread>
#include <unistd.h>

namespace graben {
namespace {

using test::Outcome;

/// A small model over a folder that holds other things too.
class ModelFolder : public test::ModelToolTest {
protected:
  using Files = std::map<std::string, std::string>;

  void SetUp() override {
    ModelToolTest::SetUp();
    makeStack("--kind normal --picks 1500", 200.0);
  }

  static std::string arguments(bool faulted) {
    return std::string("--horizon A=sample/horizon.xyz B=sample/lower.xyz --inset 400 --size 400 --results r") + (faulted ? " --fault sample/fault_1.ts" : "");
  }

  Outcome model(bool faulted, const std::string& more = "") const { return run("model", arguments(faulted) + " --quiet " + more, "DISPLAY= PATH=/nowhere"); }

  /// All files of the results but for the report, which tells the time.
  Files files() const {
    Files result;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(path("r"))) {
      const std::string name = entry.path().lexically_relative(path(".")).generic_string();
      if (entry.is_regular_file() && entry.path().filename() != "report.json")
        result[name] = content(name);
    }
    return result;
  }

  /// Starts the same, ends it after so long, and waits for its end.
  void kill(bool faulted, double seconds) const {
    const pid_t process = fork();
    if (process == 0) {
      setenv("PATH", "/nowhere", 1);
      unsetenv("DISPLAY");
      const int said = open(path("said").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
      dup2(said, STDOUT_FILENO);
      dup2(said, STDERR_FILENO);
      if (chdir(path(".").c_str()) != 0)
        _exit(99);
      execl("/bin/sh", "sh", "-c", ("exec '" GRABEN_BIN_DIR "/graben_model' " + arguments(faulted)).c_str(), nullptr);
      _exit(99);
    }
    std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
    ::kill(process, SIGKILL);
    int status = 0;
    waitpid(process, &status, 0);
  }
};

TEST_F(ModelFolder, HoldsTheLastRunAndWhatIsNotFromGraben) {
  ASSERT_EQ(model(true).code, 0);
  EXPECT_GT(names("r/blocks").size(), 4U);
  EXPECT_EQ(names("r/faults"), (std::set<std::string>{"fault_1.ply", "fault_1.ts", "allan_1_fault_1.png", "allan_1_fault_1.svg"}));
  write("r/blocks/mine.ply", "mine");
  ASSERT_EQ(model(false).code, 0);
  EXPECT_EQ(names("r/blocks"), (std::set<std::string>{"A-B.ply", "above_A.ply", "below_B.ply", "mine.ply"}));
  EXPECT_EQ(names("r").count("faults"), 0U) << "nothing is left in it";
  EXPECT_EQ(content("r/blocks/mine.ply"), "mine");
}

TEST_F(ModelFolder, RefusesToTakeThePlaceOfOtherFiles) {
  std::filesystem::create_directories(path("r/blocks"));
  write("r/blocks/A-B.ply", "mine");
  Outcome outcome = model(false);
  EXPECT_EQ(outcome.code, 4);
  EXPECT_NE(outcome.errors.find("A-B.ply: is not from an earlier run"), std::string::npos) << outcome.errors;
  EXPECT_EQ(names("r"), (std::set<std::string>{"blocks"})) << "nothing was written";
  EXPECT_EQ(content("r/blocks/A-B.ply"), "mine");
  write("r/model.msh", "mine");
  outcome = model(false);
  EXPECT_EQ(outcome.code, 2) << "told before the work starts";
  outcome = run("model", "--horizon A=sample/horizon.xyz B=sample/lower.xyz --output sample/model.msh --results sample/model.msh/r");
  EXPECT_NE(outcome.code, 0);
  outcome = run("model", "--horizon A=sample/horizon.xyz B=sample/lower.xyz --output model.msh --results .");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.errors.find("model.geo in it is --output, with model.geo too"), std::string::npos) << outcome.errors;
}

TEST_F(ModelFolder, KilledItLeavesTheOldOrTheNewModel) {
  Files whole[2];
  double seconds = 0.0;
  for (const bool faulted : {true, false}) {
    const auto begin = std::chrono::steady_clock::now();
    ASSERT_EQ(model(faulted).code, 0);
    seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    whole[faulted ? 1 : 0] = files();
  }
  constexpr int kTimes = 6;
  for (int i = 0; i < kTimes; ++i) {
    kill(i % 2 == 0, seconds * (0.3 + 0.8 * i / kTimes));
    const auto report = nlohmann::json::parse(content("r/report.json"));
    if (report.at("complete") == false)
      continue;
    Files now = files();
    for (auto file = now.begin(); file != now.end();)
      file = file->first.find(".part-") != std::string::npos ? now.erase(file) : std::next(file);
    EXPECT_TRUE(now == whole[report.at("faults").size()]) << i;
  }
  ASSERT_EQ(model(true).code, 0);
  EXPECT_TRUE(files() == whole[1]) << "what killed runs left behind is gone";
}

} // namespace
} // namespace graben
