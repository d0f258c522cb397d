#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace graben::test {

/// A file of the source tree.
inline std::string source(const std::string& file) {
  std::ifstream in(std::filesystem::path(GRABEN_SOURCE_DIR) / file, std::ios::binary);
  EXPECT_TRUE(in) << file;
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

/// README.md and the pages of config/documentation, by their paths.
inline std::vector<std::string> pages() {
  std::vector<std::string> found{"README.md"};
  for (const auto& entry : std::filesystem::directory_iterator(GRABEN_SOURCE_DIR "/config/documentation"))
    if (entry.path().extension() == ".md")
      found.push_back("config/documentation/" + entry.path().filename().string());
  std::sort(found.begin(), found.end());
  return found;
}

/// The blocks of a page fenced with ```language, in order.
inline std::vector<std::string> blocks(const std::string& page, const std::string& language) {
  std::vector<std::string> found;
  std::istringstream in(source(page));
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

} // namespace graben::test
