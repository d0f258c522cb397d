#pragma once

#include <string>
#include <string_view>

namespace graben {

/// A whole file in memory: mapped where that is possible, read otherwise (pipes); text in UTF-16 becomes UTF-8. Lives as long as
/// the views on it.
class FileContent {
public:
  /// \throw IoError if there is no such file, it is a folder or cannot be read
  explicit FileContent(const std::string& path);
  ~FileContent();
  FileContent(const FileContent&) = delete;
  FileContent& operator=(const FileContent&) = delete;

  std::string_view bytes() const { return bytes_; }

  /// Has \a part in memory before it is read, at less cost than page by page. Thread-safe.
  void load(std::string_view part) const;

  /// Gives the memory of \a part back; read again, it comes back from the file. Thread-safe.
  void release(std::string_view part) const;

private:
  void takeUtf16();
  bool holds(std::string_view part) const;

  std::string_view bytes_;
  std::string copy_;
  void* mapping_ = nullptr;
};

/// The file's text without byte order mark, with \n or \r\n line ends; \a storage holds a copy
/// where one is needed.
/// \throw ParseError if the file is empty or binary
std::string_view textOf(const FileContent& content, const std::string& path, std::string& storage);

/// The file's name without folder and extension.
std::string stemOf(const std::string& path);

} // namespace graben
