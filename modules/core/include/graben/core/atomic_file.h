#pragma once

#include "graben/core/export.h"
#include "graben/core/unfinished_files.h"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

GRABEN_EXPORT_BEGIN
namespace graben {

/// A file that appears under its name only when it is complete: written beside, then renamed.
///
/// Without commit() the destructor removes what was written and a former file of that name stays as
/// it was. Where the name is not a regular file (/dev/stdout, a pipe) it is written directly.
/// Symbolic links are followed, also to files that are not there yet. One thread at a time.
class AtomicFile {
public:
  /// \throw WriteError if the file is write-protected or none can be made in the folder of \a path
  explicit AtomicFile(std::string path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Appends to the file; gathers small pieces before they go to the system.
  /// \throw WriteError if the disk is full or the file was closed
  void write(std::string_view bytes);

  /// Appends the object representation of a number (little endian on the machines PCL runs on).
  template <typename Number>
  void writeRaw(const Number& value) {
    write({reinterpret_cast<const char*>(&value), sizeof(value)});
  }

  /// The name the file has until commit(), for libraries that write by name; do not mix with
  /// write().
  const std::string& writingPath() const { return temporary_ ? temporary_->path() : path_; }

  /// Makes the file appear under its name.
  /// \throw WriteError if the rest cannot be written, the file cannot be closed or renamed
  void commit();

private:
  void flush();
  void send(std::string_view bytes);
  void close();

  std::string path_;
  std::string target_;
  std::optional<UnfinishedFile> temporary_; ///< absent where the file is written directly
  std::string buffer_;
  int descriptor_ = -1;
  bool committed_ = false;
};

/// Writes all of a file, as an AtomicFile: complete or not at all. O(n), threads may write different files.
/// \param[in] path of a file in a folder that exists; a former file of that name gives way \param[in] bytes all that it holds, may be none
/// \throw WriteError if the file is write-protected, none can be made in its folder, or the disk is full
void writeFile(const std::string& path, std::string_view bytes);

/// The place that \a path names after all symbolic links and dots, also where no file is there yet.
std::string resolvedPath(const std::string& path);

/// Finds out whether \a path could be written as an AtomicFile, without touching what is there: its folder, permissions, a little room.
/// \throw WriteError if not
void checkWritable(const std::string& path);

} // namespace graben
GRABEN_EXPORT_END
