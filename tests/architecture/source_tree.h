#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace graben::test {

/// A text file of the source tree.
struct SourceFile {
  std::string path; ///< relative to the top of the tree
  std::vector<std::string> lines;

  std::string extension() const { return std::filesystem::path(path).extension().string(); }
  bool isCpp() const { return extension() == ".h" || extension() == ".hpp" || extension() == ".cpp"; }
  bool under(const std::string& folder) const { return path.rfind(folder, 0) == 0; }
};

/// The files below modules, tools, tests and config that people write, in order of their paths.
inline std::vector<SourceFile> sourceTree() {
  const std::filesystem::path top = GRABEN_SOURCE_DIR;
  std::vector<std::filesystem::path> paths;
  for (const char* folder : {"modules", "tools", "tests", "config"})
    for (const auto& entry : std::filesystem::recursive_directory_iterator(top / folder))
      if (entry.is_regular_file())
        paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  std::vector<SourceFile> files;
  for (const auto& path : paths) {
    const std::string extension = path.extension().string();
    const bool script = extension.empty() || extension == ".txt" || extension == ".cmake" || extension == ".in";
    SourceFile file{std::filesystem::relative(path, top).string(), {}};
    if (!file.isCpp() && !script && extension != ".md")
      continue;
    std::ifstream in(path);
    for (std::string line; std::getline(in, line);)
      file.lines.push_back(line);
    files.push_back(std::move(file));
  }
  return files;
}

} // namespace graben::test
