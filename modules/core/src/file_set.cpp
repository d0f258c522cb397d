#include "graben/core/file_set.h"

#include "graben/core/atomic_file.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <sys/stat.h>
#include <unistd.h>

namespace graben {
namespace {

namespace fs = std::filesystem;

const std::string manifest_title = "# Written by graben. The next run replaces or removes the files named here, and no others.";

bool isRegular(const fs::path& file) {
  std::error_code error;
  return fs::is_regular_file(fs::symlink_status(file, error));
}

bool isThere(const fs::path& file) {
  std::error_code error;
  return fs::exists(fs::symlink_status(file, error));
}

/// A file's name, perhaps in folders below, and no way out of the folder.
bool isNameBelow(const std::string& name) {
  const fs::path path = name;
  const auto is_plain = [](const fs::path& part) { return !part.empty() && part != "." && part != ".."; };
  return !name.empty() && path.is_relative() && std::all_of(path.begin(), path.end(), is_plain);
}

/// The first of the folders on the way to a name that is there and no folder of its own, such as a file or a link; empty if there is none.
fs::path obstacle(const fs::path& folder, const std::string& name) {
  fs::path below;
  for (const fs::path& part : fs::path(name).parent_path()) {
    below /= part;
    std::error_code error;
    const fs::file_status status = fs::symlink_status(folder / below, error);
    if (fs::exists(status) && !fs::is_directory(status))
      return below;
  }
  return {};
}

std::string manifestOf(const std::set<std::string>& names) {
  std::string text = manifest_title + "\n";
  for (const std::string& name : names)
    text += name + "\n";
  return text;
}

/// What is no folder, by its name seen from \a folder.
std::set<std::string> filesBelow(const fs::path& folder) {
  std::set<std::string> names;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
    if (!fs::is_directory(entry.symlink_status()))
      names.insert(entry.path().lexically_relative(folder).generic_string());
  return names;
}

/// Folders that held the file and hold nothing any longer.
void removeEmptyFolders(const fs::path& folder, const std::string& name) {
  for (fs::path below = fs::path(name).parent_path(); !below.empty() && ::rmdir((folder / below).c_str()) == 0;)
    below = below.parent_path();
}

/// What folders for files that are not yet in place begin with on this machine.
std::string stagingPrefix() {
  char host[256] = "";
  ::gethostname(host, sizeof(host) - 1);
  return std::string(".graben-") + host;
}

void makeFolderOf(const fs::path& file) {
  std::error_code error;
  fs::create_directories(file.parent_path(), error);
  if (error)
    throw WriteError(file.parent_path().string(), "the folder cannot be made: " + error.message());
}

void move(const fs::path& from, const fs::path& to) {
  std::error_code error;
  fs::rename(from, to, error);
  if (error)
    throw WriteError(to.string(), "cannot be put in place: " + error.message() + "; its folder holds files of two runs, run it again");
}

} // namespace

FileSet::FileSet(const std::string& folder, FileSetNames names)
  : told_folder_(folder), folder_(resolvedPath(folder)), names_(std::move(names)) {
  for (fs::path path = folder_; !isThere(path) && path.has_relative_path(); path = path.parent_path())
    made_.insert(made_.begin(), path.string());
  std::error_code error;
  fs::create_directories(folder_, error);
  if (error)
    throw WriteError(folder, "the folder cannot be made: " + error.message());
  removeLeftovers();
  staging_.emplace(temporaryName(folder_ + "/" + stagingPrefix()));
  if (::mkdir(staging().c_str(), 0777) != 0)
    throw WriteError(folder, "no files may be made in this folder: " + std::error_code(errno, std::generic_category()).message());
}

FileSet::~FileSet() {
  std::error_code ignored;
  fs::remove_all(staging(), ignored);
  for (auto folder = made_.rbegin(); !committed_ && folder != made_.rend(); ++folder)
    ::rmdir(folder->c_str());
}

/// What runs that were killed left behind.
void FileSet::removeLeftovers() const {
  const std::string start = stagingPrefix() + ".part-";
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_)) {
    const std::string name = entry.path().filename().string();
    if (name.rfind(start, 0) != 0)
      continue;
    const long process = std::strtol(name.c_str() + start.size(), nullptr, 10);
    std::error_code ignored;
    if (process > 0 && ::kill(static_cast<pid_t>(process), 0) != 0 && errno == ESRCH)
      fs::remove_all(fs::path(folder_) / name, ignored);
  }
}

std::set<std::string> FileSet::namesIn(const std::string& folder, const FileSetNames& names) {
  std::set<std::string> result;
  std::ifstream manifest(fs::path(folder) / names.manifest);
  std::string line;
  if (!std::getline(manifest, line) || line != manifest_title)
    return result;
  result.insert(names.manifest);
  while (std::getline(manifest, line))
    if (isNameBelow(line) && obstacle(folder, line).empty() && isRegular(fs::path(folder) / line))
      result.insert(line);
  return result;
}

std::vector<std::string> FileSet::notOfTheSet(const std::string& folder, const FileSetNames& names, const std::vector<std::string>& wanted) {
  const std::set<std::string> own = namesIn(folder, names);
  std::vector<std::string> result;
  for (const std::string& name : wanted) {
    const fs::path before = obstacle(folder, name);
    if (!before.empty())
      result.push_back(before.string());
    else if (own.count(name) == 0 && isThere(fs::path(folder) / name))
      result.push_back(name);
  }
  return result;
}

WriteError FileSet::inPlace(const IoError& error) const {
  return {(fs::path(told_folder_) / fs::path(error.file()).lexically_relative(staging())).string(), error.reason()};
}

std::vector<std::string> FileSet::commit() {
  const fs::path folder = folder_;
  const fs::path from = staging();
  std::set<std::string> files = filesBelow(from);
  files.insert(names_.manifest);
  const std::vector<std::string> result(files.begin(), files.end());
  const std::vector<std::string> foreign = notOfTheSet(folder_, names_, result);
  if (!foreign.empty())
    throw WriteError((folder / foreign.front()).string(),
                     "is not from an earlier run and would be lost; move it away or choose another folder");
  const std::set<std::string> former = namesIn(folder_, names_);
  std::set<std::string> both = files;
  both.insert(former.begin(), former.end());
  const fs::path next = from / (names_.manifest + ".next");
  const fs::path unsealed = from / (names_.seal + ".incomplete");
  writeFile(next, manifestOf(both));
  writeFile(unsealed, names_.incomplete);
  writeFile(from / names_.manifest, manifestOf(files));

  const auto undisturbed = holdUnfinishedFiles();
  committed_ = true;
  for (const std::string& name : result)
    makeFolderOf(folder / name);
  move(next, folder / names_.manifest);
  move(unsealed, folder / names_.seal);
  for (const std::string& name : result)
    if (name != names_.seal && name != names_.manifest)
      move(from / name, folder / name);
  for (const std::string& name : former) {
    if (files.count(name) != 0)
      continue;
    if (::unlink((folder / name).c_str()) != 0 && errno != ENOENT)
      throw WriteError((folder / name).string(), "is from the former run and cannot be removed; run it again");
    removeEmptyFolders(folder, name);
  }
  move(from / names_.manifest, folder / names_.manifest);
  move(from / names_.seal, folder / names_.seal);
  return result;
}

void checkFolderWritable(const std::string& folder) {
  fs::path place = resolvedPath(folder);
  while (!isThere(place) && place.has_relative_path())
    place = place.parent_path();
  if (!fs::is_directory(place))
    throw WriteError(folder, "the folder cannot be made: " + place.string() + " is a file");
  try {
    checkWritable((place / stagingPrefix()).string());
  } catch (const WriteError&) {
    throw WriteError(folder, "no files may be made in the folder " + place.string() + ": no permission, or no room");
  }
}

} // namespace graben
