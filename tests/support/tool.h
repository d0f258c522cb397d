#pragma once

#include <gtest/gtest.h>

#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>

namespace graben::test {

/// How a command ended and what it said.
struct Outcome {
  int code = -1;      ///< exit code; 128 and more: ended by a signal
  std::string output; ///< standard output
  std::string errors; ///< standard error
};

/// Tests that run the built commands in a folder of their own, at first empty.
class ToolTest : public testing::Test {
protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    std::string name = "graben_" + std::string(test->test_suite_name()) + "_" + test->name();
    std::replace(name.begin(), name.end(), '/', '_');
    folder_ = std::filesystem::temp_directory_path() / name;
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  /// Runs "graben_<tool> <arguments>" through the shell, in the test's folder.
  /// \param[in] environment assignments for the command alone, such as "DISPLAY="
  Outcome run(const std::string& tool, const std::string& arguments,
              const std::string& environment = "") const {
    const std::string errors = "standard_error.txt";
    const std::string command = "cd '" + folder_.string() + "' && " + environment +
                                " '" GRABEN_BIN_DIR "/graben_" + tool + "' " + arguments + " 2> " +
                                errors;
    Outcome outcome;
    FILE* pipe = popen(command.c_str(), "r");
    std::array<char, 4096> buffer{};
    for (std::size_t n; (n = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
      outcome.output.append(buffer.data(), n);
    const int status = pclose(pipe);
    outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    outcome.errors = content(errors);
    std::filesystem::remove(path(errors));
    return outcome;
  }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  std::string content(const std::string& name) const {
    std::ifstream in(path(name), std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
  }

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(path(name), std::ios::binary) << text;
  }

  /// The names of everything in a folder of the test.
  std::set<std::string> names(const std::string& folder = ".") const {
    std::set<std::string> result;
    for (const auto& entry : std::filesystem::directory_iterator(path(folder)))
      result.insert(entry.path().filename().string());
    return result;
  }

private:
  std::filesystem::path folder_;
};

} // namespace graben::test
