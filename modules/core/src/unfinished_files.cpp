#include "graben/core/unfinished_files.h"

#include <atomic>
#include <filesystem>
#include <set>
#include <system_error>
#include <unistd.h>

namespace graben {
namespace {

/// Never destroyed, as the thread that ends the program may outlive static objects.
struct Registry {
  std::mutex guard;
  std::multiset<std::string> paths;
};

Registry& registry() {
  static auto* const instance = new Registry;
  return *instance;
}

} // namespace

UnfinishedFile::UnfinishedFile(std::string path)
  : path_(std::move(path)) {
  const auto lock = holdUnfinishedFiles();
  registry().paths.insert(path_);
}

UnfinishedFile::~UnfinishedFile() {
  const auto lock = holdUnfinishedFiles();
  registry().paths.erase(registry().paths.find(path_));
}

std::string temporaryName(const std::string& stem) {
  static std::atomic<unsigned> counter{0};
  return stem + ".part-" + std::to_string(::getpid()) + "-" + std::to_string(counter++);
}

std::unique_lock<std::mutex> holdUnfinishedFiles() { return std::unique_lock(registry().guard); }

std::unique_lock<std::mutex> removeUnfinishedFiles() {
  auto lock = holdUnfinishedFiles();
  std::error_code ignored;
  for (const std::string& path : registry().paths)
    std::filesystem::remove_all(path, ignored);
  return lock;
}

} // namespace graben
