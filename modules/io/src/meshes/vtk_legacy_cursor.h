#pragma once

#include "content/binary_value.h"

#include <string>
#include <string_view>
#include <vector>

namespace graben {

/// Goes through a legacy VTK file: words and arrays of numbers, in text or big endian.
class VtkLegacyCursor {
public:
  VtkLegacyCursor(std::string_view bytes, const std::string& path)
      : bytes_(bytes)
      , path_(path) {}

  void setBinary(bool binary) { binary_ = binary; }

  /// The rest of the line.
  std::string_view line();

  /// The next word, over line ends; empty at the end of the file.
  std::string_view word();

  /// Goes past the next word if it is the one given, in lower case.
  bool passWord(std::string_view wanted);

  /// The next word, which must be a count.
  std::size_t count();

  /// The next word, which must be the name of a number type.
  BinaryType type();

  /// True if more words follow on this line.
  bool moreOnLine() const;

  /// An array; the file must hold all of it, so no count makes it allocate more than the file fills.
  std::vector<double> numbers(std::size_t rows, std::size_t columns, BinaryType type);

  [[noreturn]] void fail(const std::string& message) const;

private:
  std::string_view bytes_;
  const std::string& path_;
  std::size_t at_ = 0;
  bool binary_ = false;
};

} // namespace graben
