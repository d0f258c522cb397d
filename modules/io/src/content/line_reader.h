#pragma once

#include <cstddef>
#include <cstring>
#include <string_view>
#include <vector>

namespace graben {

/// Goes through a text line by line and counts; line ends \n and \r\n are left off.
class LineReader {
public:
  explicit LineReader(std::string_view text, std::size_t first_line = 1)
      : rest_(text)
      , number_(first_line - 1) {}

  /// \returns false at the end of the text
  bool next(std::string_view& line) {
    if (rest_.empty())
      return false;
    const void* newline = std::memchr(rest_.data(), '\n', rest_.size());
    const std::size_t length =
        newline == nullptr ? rest_.size() : static_cast<const char*>(newline) - rest_.data();
    line = rest_.substr(0, length);
    if (!line.empty() && line.back() == '\r')
      line.remove_suffix(1);
    rest_.remove_prefix(newline == nullptr ? length : length + 1);
    ++number_;
    return true;
  }

  /// Number of the line last read, from 1.
  std::size_t number() const { return number_; }
  std::string_view rest() const { return rest_; }

private:
  std::string_view rest_;
  std::size_t number_;
};

/// The words of a line, parted by blanks and tabs; a quoted text is one word without its quotes.
void splitWords(std::string_view line, std::vector<std::string_view>& words);

} // namespace graben
