#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <sstream>

namespace {

std::string readText(const std::string& file) {
  std::ifstream in(file);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

std::string capture(const std::string& text, const std::string& pattern) {
  std::smatch match;
  return std::regex_search(text, match, std::regex(pattern)) ? match[1].str() : std::string();
}

/// package.xml is the one place: the build and the installed package say the same.
TEST(Version, IsTheSameEverywhere) {
  const std::string version =
      capture(readText(GRABEN_SOURCE_DIR "/package.xml"), "<version>([0-9]+\\.[0-9]+\\.[0-9]+)</version>");
  ASSERT_FALSE(version.empty());
  EXPECT_EQ(version, GRABEN_BUILD_VERSION);
  EXPECT_EQ(version, capture(readText(GRABEN_BUILD_DIR "/grabenConfigVersion.cmake"), "PACKAGE_VERSION \"([^\"]+)\""));
}

TEST(Version, CMakeListsNamesNone) {
  EXPECT_EQ(capture(readText(GRABEN_SOURCE_DIR "/CMakeLists.txt"), "VERSION ([0-9]+\\.[0-9]+\\.[0-9]+)"), "");
}

} // namespace
