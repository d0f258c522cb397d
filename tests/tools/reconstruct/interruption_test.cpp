#include "support/tool.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <map>
#include <random>
#include <thread>
#include <unistd.h>

namespace graben {
namespace {

using Clock = std::chrono::steady_clock;
using testing::HasSubstr;

/// Runs that are ended at any moment, over a results folder of one set, two faults, or the other, one fault.
class Interruption : public test::ToolTest {
protected:
  using Files = std::map<std::string, std::string>;

  void SetUp() override {
    ToolTest::SetUp();
    ASSERT_EQ(run("synthesize", "--output s --kind branch --picks 1500 --quiet").code, 0);
    for (const int faults : {2, 1}) {
      const Clock::time_point begin = Clock::now();
      ASSERT_EQ(waitFor(start(faults)), 0);
      whole_[faults - 1] = files();
      seconds_ = std::chrono::duration<double>(Clock::now() - begin).count();
    }
  }

  /// The tool with so many faults, no display and two threads; what it says goes to the file "said".
  pid_t start(int faults) const {
    const pid_t process = fork();
    if (process != 0)
      return process;
    const int said = open(path("said").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
    dup2(said, STDOUT_FILENO);
    dup2(said, STDERR_FILENO);
    setenv("PATH", "/nowhere", 1);
    unsetenv("DISPLAY");
    if (chdir(path(".").c_str()) != 0)
      _exit(99);
    execl(GRABEN_BIN_DIR "/graben_reconstruct", "graben_reconstruct", "--horizon", "s/horizon.xyz", "--threads", "2", "--output", "o.ply", "--results", "r",
          "--fault", "s/fault_1.ts", faults > 1 ? "s/fault_2.ts" : nullptr, nullptr);
    _exit(99);
  }

  /// \return the exit code; 128 and more: ended by a signal
  static int waitFor(pid_t process) {
    int status = 0;
    waitpid(process, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }

  /// The results folder but for the reports, which tell the time.
  Files files() const {
    Files result;
    for (const std::string& name : names("r"))
      if (name != "report.json" && name != "report.html" && std::filesystem::is_regular_file(path("r/" + name)))
        result[name] = content("r/" + name);
    return result;
  }

  /// Starts a run over the folder as it is and ends it at a random instant of its life. \return its exit code
  int interrupt(int faults, int signal) {
    const pid_t process = start(faults);
    std::this_thread::sleep_for(std::chrono::duration<double>(seconds_ * std::uniform_real_distribution(0.1, 1.1)(random_)));
    kill(process, signal);
    const Clock::time_point begin = Clock::now();
    const int code = waitFor(process);
    if (signal != SIGKILL) {
      EXPECT_LT(std::chrono::duration<double>(Clock::now() - begin).count(), 1.0);
    }
    return code;
  }

  /// The folder holds the one set or the other, or says that it is not whole.
  void expectWholeOrSaid() const {
    const auto report = nlohmann::json::parse(content("r/report.json"));
    if (report.at("complete") == false)
      return;
    const std::size_t faults = report.at("faults").size();
    ASSERT_TRUE(faults == 1 || faults == 2);
    EXPECT_TRUE(files() == whole_[faults - 1]) << faults;
  }

  Files whole_[2];
  double seconds_ = 0.0;
  std::mt19937 random_{7};
};

TEST_F(Interruption, LeavesNoTemporaryFilesAndAWholeSet) {
  for (int i = 0; i < 12; ++i) {
    const int signal = i % 2 == 0 ? SIGINT : SIGTERM;
    const int code = interrupt(1 + i / 2 % 2, signal);
    EXPECT_TRUE(code == 128 + signal || code == 0) << code;
    if (code != 0) {
      EXPECT_THAT(content("said"), HasSubstr("graben_reconstruct: interrupted"));
    }
    EXPECT_EQ(names(), (std::set<std::string>{"o.ply", "r", "s", "said"}));
    for (const std::string& name : names("r"))
      EXPECT_EQ(name.find("part"), std::string::npos) << name;
    EXPECT_EQ(nlohmann::json::parse(content("r/report.json")).at("complete"), true);
    expectWholeOrSaid();
  }
}

TEST_F(Interruption, KilledAtThirtyInstantsLeavesOldOrNew) {
  for (int i = 0; i < 30; ++i) {
    const std::string former = content("o.ply");
    interrupt(1 + i % 2, SIGKILL);
    expectWholeOrSaid();
    EXPECT_TRUE(content("o.ply") == former || content("o.ply") == whole_[i % 2]["surface.ply"]);
  }
  // The next run takes away what was left behind.
  ASSERT_EQ(waitFor(start(2)), 0);
  expectWholeOrSaid();
  for (const std::string& name : names("r"))
    EXPECT_EQ(name.find("part"), std::string::npos) << name;
}

} // namespace
} // namespace graben
