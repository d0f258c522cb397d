#pragma once

#include <charconv>
#include <cstdint>
#include <cstring>
#include <vector>

namespace graben {

/// Reads rows of plain decimal numbers, as nearly all rows are. Whatever it takes, parseTableRow takes with the same numbers; whatever is
/// unusual (exponents, words, quotes, comments, missing fields) it leaves.
class FastRow {
public:
  /// \param[in] slots for each column up to the last one looked at, which number of the row it is; -1 for none
  /// \param[in] exact no column may follow
  /// \param[in] end of the text
  FastRow(char delimiter, const std::vector<int>& slots, bool exact, const char* end)
      : delimiter_(delimiter)
      , slots_(slots.data())
      , slots_end_(slots.data() + slots.size())
      , exact_(exact)
      , end_(end) {}

  /// Reads the row that starts at \a at; a line end must follow somewhere.
  /// \returns the start of the next row, or nullptr if the row is left to others
  template <typename Row>
  const char* read(const char* at, Row& row) const {
    return delimiter_ == ' ' ? readBlanks(at, row) : readDelimited(at, row);
  }

private:
  static bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

  static const char* skipBlanks(const char* at) {
    while (isBlank(*at))
      ++at;
    return at;
  }

  /// Comments, empty lines and quoted words are for others.
  static bool startsRow(char c) { return c != '#' && c != '!' && c != '@' && c != '/' && c != '"' && c != '\n'; }

  static const char* nextLine(const char* at, const char* end) {
    if (*at == '\n')
      return at + 1;
    return static_cast<const char*>(std::memchr(at, '\n', static_cast<std::size_t>(end - at))) + 1;
  }

  template <typename Row>
  const char* readBlanks(const char* at, Row& row) const {
    at = skipBlanks(at);
    if (!startsRow(*at))
      return nullptr;
    for (const int* slot = slots_; slot != slots_end_; ++slot) {
      at = skipBlanks(at);
      if (*slot >= 0) {
        at = number(at, row[*slot]);
        if (at == nullptr || !(isBlank(*at) || *at == '\n'))
          return nullptr;
      } else {
        if (*at == '"' || *at == '\n')
          return nullptr;
        while (!isBlank(*at) && *at != '\n')
          ++at;
      }
    }
    if (exact_ && *(at = skipBlanks(at)) != '\n')
      return nullptr;
    return nextLine(at, end_);
  }

  template <typename Row>
  const char* readDelimited(const char* at, Row& row) const {
    if (!startsRow(*skipBlanks(at)))
      return nullptr;
    for (const int* slot = slots_; slot != slots_end_; ++slot) {
      if (slot != slots_ && *at++ != delimiter_)
        return nullptr;
      if (*slot >= 0) {
        at = number(skipPadding(at), row[*slot]);
        if (at == nullptr)
          return nullptr;
        at = skipPadding(at);
      } else {
        while (*at != delimiter_ && *at != '\n' && *at != '"')
          ++at;
      }
      if (*at != delimiter_ && *at != '\n')
        return nullptr;
    }
    if (exact_ && *at != '\n')
      return nullptr;
    return nextLine(at, end_);
  }

  const char* skipPadding(const char* at) const {
    while (isBlank(*at) && *at != delimiter_)
      ++at;
    return at;
  }

  /// A decimal of up to 18 digits; the division is exact in what it rounds to where numerator and power of ten are doubles.
  const char* number(const char* at, double& value) const {
    static constexpr double powers[] = {1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18};
    const char* first = at;
    const bool negative = *at == '-';
    at += negative ? 1 : 0;
    const char* digits = at;
    std::uint64_t mantissa = 0;
    for (unsigned d = 0; (d = static_cast<unsigned char>(*at) - unsigned{'0'}) < 10; ++at)
      mantissa = 10 * mantissa + d;
    std::ptrdiff_t count = at - digits;
    std::ptrdiff_t decimals = 0;
    if (*at == '.') {
      const char* fraction = ++at;
      for (unsigned d = 0; (d = static_cast<unsigned char>(*at) - unsigned{'0'}) < 10; ++at)
        mantissa = 10 * mantissa + d;
      decimals = at - fraction;
      count += decimals;
    }
    if (count == 0)
      return nullptr;
    if (count > 18 || mantissa > (std::uint64_t{1} << 53)) {
      const auto result = std::from_chars(first, end_, value);
      return result.ec == std::errc() ? result.ptr : nullptr;
    }
    const double size = static_cast<double>(mantissa) / powers[decimals];
    value = negative ? -size : size;
    return at;
  }

  char delimiter_;
  const int* slots_;
  const int* slots_end_;
  bool exact_;
  const char* end_;
};

} // namespace graben
