#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace graben {

/// A file that appears under its name only when it is complete: written beside, then renamed.
///
/// Without commit() the destructor removes what was written and a former file of that name stays as
/// it was. Where the name is not a regular file (/dev/stdout, a pipe) it is written directly.
/// Symbolic links are followed. One thread at a time.
class AtomicFile {
public:
  /// \throw IoError if no file can be made in the folder of \a path
  explicit AtomicFile(std::string path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Appends to the file; gathers small pieces before they go to the system.
  /// \throw IoError if the disk is full or the file was closed
  void write(std::string_view bytes);

  /// Appends the object representation of a number (little endian on the machines PCL runs on).
  template <typename Number>
  void writeRaw(const Number& value) {
    write({reinterpret_cast<const char*>(&value), sizeof(value)});
  }

  /// The name the file has until commit(), for libraries that write by name; do not mix with
  /// write().
  const std::string& temporaryPath() const { return temporary_; }

  /// Makes the file appear under its name.
  /// \throw IoError if the rest cannot be written, the file cannot be closed or renamed
  void commit();

private:
  void flush();
  void send(std::string_view bytes);
  void close();

  std::string path_;
  std::string target_;
  std::string temporary_;
  std::string buffer_;
  int descriptor_ = -1;
  bool direct_ = false;
  bool committed_ = false;
};

} // namespace graben
