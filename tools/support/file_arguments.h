#pragma once

#include "support/options.h"

#include "graben/core/file_set.h"

#include <string>
#include <vector>

namespace graben {

/// A file that a command was told to read or to write.
struct FileArgument {
  std::string told; ///< by which words: "--horizon", "OUTPUT.ply"
  std::string path;
};

/// The files that \a options name, in that order; options that were not given name none.
std::vector<FileArgument> filesOf(const OptionValues& values, const std::vector<std::string>& options);

/// True if both name the same regular file, through whatever links, or will once it is written.
bool isSameFile(const std::string& a, const std::string& b);

/// Refuses outputs that would take the place of an input or of each other, before anything is read, and those that cannot be written.
/// \throw UsageError that names both
/// \throw WriteError as checkWritable()
void checkOutputs(const std::vector<FileArgument>& outputs, const std::vector<FileArgument>& inputs);

/// Refuses an output folder that cannot be written to, or where a file that would be replaced or removed is an input, another output, or from
/// something else than an earlier run.
/// \param[in] set   tells which files are from an earlier run
/// \param[in] names files that will be written
/// \throw UsageError, WriteError
void checkOutputFolder(const FileArgument& folder, const FileSetNames& set, const std::vector<std::string>& names,
                       const std::vector<FileArgument>& inputs, const std::vector<FileArgument>& outputs);

} // namespace graben
