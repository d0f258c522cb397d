#include "support/file_arguments.h"

#include "graben/core/atomic_file.h"

#include <filesystem>
#include <sys/stat.h>

namespace graben {
namespace {

std::string shown(const FileArgument& file) { return file.told + " " + file.path; }

} // namespace

std::vector<FileArgument> filesOf(const OptionValues& values, const std::vector<std::string>& options) {
  std::vector<FileArgument> files;
  for (const std::string& option : options)
    if (values.has(option))
      for (const std::string& path : values.texts(option))
        files.push_back({"--" + option, path});
  return files;
}

bool isSameFile(const std::string& a, const std::string& b) {
  struct stat of_a {};
  struct stat of_b {};
  const bool has_a = ::stat(a.c_str(), &of_a) == 0;
  const bool has_b = ::stat(b.c_str(), &of_b) == 0;
  if (has_a && has_b)
    return S_ISREG(of_a.st_mode) && of_a.st_dev == of_b.st_dev && of_a.st_ino == of_b.st_ino;
  return !has_a && !has_b && resolvedPath(a) == resolvedPath(b);
}

void checkOutputs(const std::vector<FileArgument>& outputs, const std::vector<FileArgument>& inputs) {
  for (const FileArgument& output : outputs)
    for (const FileArgument& input : inputs)
      if (isSameFile(output.path, input.path))
        throw UsageError(shown(output) + " is the same file as " + shown(input) + ", which would be overwritten; choose another name");
  for (auto output = outputs.begin(); output != outputs.end(); ++output)
    for (auto other = output + 1; other != outputs.end(); ++other)
      if (isSameFile(output->path, other->path))
        throw UsageError(shown(*output) + " and " + shown(*other) + " are the same file; choose another name for one of them");
  for (const FileArgument& output : outputs)
    checkWritable(output.path);
}

void checkOutputFolder(const FileArgument& folder, const FileSetNames& set, const std::vector<std::string>& names,
                       const std::vector<FileArgument>& inputs, const std::vector<FileArgument>& outputs) {
  checkFolderWritable(folder.path);
  std::set<std::string> touched = FileSet::namesIn(folder.path, set);
  touched.insert(names.begin(), names.end());
  for (const std::string& name : touched) {
    const std::string file = (std::filesystem::path(folder.path) / name).string();
    for (const FileArgument& input : inputs)
      if (isSameFile(file, input.path))
        throw UsageError(shown(folder) + ": " + name + " in it is what " + input.told + " reads, and would be replaced; choose another folder");
    for (const FileArgument& output : outputs)
      if (isSameFile(file, output.path))
        throw UsageError(shown(folder) + ": " + name + " in it is " + shown(output) + " too; choose another name or folder");
  }
  const std::vector<std::string> foreign = FileSet::notOfTheSet(folder.path, set, names);
  if (!foreign.empty())
    throw UsageError(shown(folder) + ": " + foreign.front() +
                     " in it is not from an earlier run and would be lost; move it away or choose another folder");
}

} // namespace graben
