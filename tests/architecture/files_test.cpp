#include "source_tree.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

namespace graben::test {
namespace {

TEST(Files, StaySmall) {
  constexpr std::size_t kMostLines = 600;
  constexpr std::size_t kMedianLines = 150;
  std::vector<std::size_t> lengths;
  for (const SourceFile& file : sourceTree()) {
    if (!file.isCpp())
      continue;
    EXPECT_LE(file.lines.size(), kMostLines) << file.path << " wants to be split";
    lengths.push_back(file.lines.size());
  }
  ASSERT_GT(lengths.size(), 10U) << "the source tree was not found";
  std::nth_element(lengths.begin(), lengths.begin() + lengths.size() / 2, lengths.end());
  EXPECT_LE(lengths[lengths.size() / 2], kMedianLines);
}

TEST(Files, LinesStayShort) {
  constexpr std::size_t kWidest = 160;
  for (const SourceFile& file : sourceTree())
    for (std::size_t i = 0; file.isCpp() && i < file.lines.size(); ++i)
      EXPECT_LE(file.lines[i].size(), kWidest) << file.path << ":" << i + 1;
}

TEST(Files, OfAModuleAreDividedIntoFoldersBeforeTheyAreTooMany) {
  constexpr int kMostSources = 20;
  std::map<std::string, int> sources;
  for (const SourceFile& file : sourceTree())
    if (file.under("modules/") && file.extension() == ".cpp")
      ++sources[std::filesystem::path(file.path).parent_path().string()];
  for (const auto& [folder, count] : sources)
    EXPECT_LE(count, kMostSources) << folder << " wants to be divided by subject";
  EXPECT_GT(sources.size(), 30U) << "the folders were not found";
}

/// How many arguments stand in the parentheses that open at a place of a text.
int argumentsAt(const std::string& text, std::size_t open) {
  int depth = 0, count = 1;
  for (std::size_t i = open; i < text.size(); ++i) {
    const char c = text[i];
    depth += (c == '(' || c == '{' || c == '[') - (c == ')' || c == '}' || c == ']');
    count += c == ',' && depth == 1;
    if (depth == 0)
      break;
  }
  return count;
}

/// Without names of their own they are numbered or print bytes, which say nothing and change from build to build.
TEST(Files, NameTheCasesOfParametrisedTests) {
  const std::string macro = std::string("INSTANTIATE_TEST") + "_SUITE_P";
  int found = 0;
  for (const SourceFile& file : sourceTree()) {
    std::string text;
    for (const std::string& line : file.lines)
      text += line + "\n";
    for (auto at = text.find(macro + "("); at != std::string::npos; at = text.find(macro + "(", at + 1), ++found)
      EXPECT_GE(argumentsAt(text, at + macro.size()), 4) << file.path << ": " << text.substr(at, text.find('\n', at) - at);
  }
  EXPECT_GT(found, 15);
}

TEST(Files, NothingIsLeftForLater) {
  const auto word = [](const std::string& first, const std::string& second) { return first + second; };
  const std::vector<std::string> forbidden = {word("TO", "DO"),           word("FIX", "ME"),         word("XX", "X:"),
                                              word("HA", "CK"),           word("not imple", "mented"),
                                              word("-march", "=native")};
  for (const SourceFile& file : sourceTree())
    for (std::size_t i = 0; i < file.lines.size(); ++i)
      for (const std::string& text : forbidden)
        EXPECT_EQ(file.lines[i].find(text), std::string::npos) << file.path << ":" << i + 1 << " has '" << text << "'";
}

TEST(Files, NoPathsOfOneMachine) {
  const std::vector<std::string> forbidden = {std::string("/wo") + "rk/", std::string("/ho") + "me/"};
  for (const SourceFile& file : sourceTree())
    for (std::size_t i = 0; i < file.lines.size(); ++i)
      for (const std::string& text : forbidden)
        EXPECT_EQ(file.lines[i].find(text), std::string::npos) << file.path << ":" << i + 1;
}

TEST(Files, EveryModuleSaysWhatItIs) {
  for (const auto& entry : std::filesystem::directory_iterator(GRABEN_SOURCE_DIR "/modules"))
    EXPECT_TRUE(!entry.is_directory() || std::filesystem::exists(entry.path() / "README.md"))
        << entry.path() << " has no README.md";
}

TEST(Files, TopLevelIsFixed) {
  const std::set<std::string> rooms = {"modules",     "tools",     "tests",   "config", "CMakeLists.txt",
                                       "package.xml", "README.md", "LICENSE", "build",  "install", "log", "results"};
  for (const auto& entry : std::filesystem::directory_iterator(GRABEN_SOURCE_DIR)) {
    const std::string name = entry.path().filename().string();
    EXPECT_TRUE(name.front() == '.' || name.rfind("build", 0) == 0 || rooms.count(name)) << name;
  }
}

} // namespace
} // namespace graben::test
