#include "content/numbers.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace graben {
namespace {

/// Numbers std::from_chars does not take: out of range, or with a D for the exponent.
const char* parseUnusualNumber(const char* begin, const char* end, double& value) {
  std::array<char, 64> copy{};
  const auto length = std::min<std::size_t>(static_cast<std::size_t>(end - begin), copy.size() - 1);
  std::transform(begin, begin + length, copy.begin(),
                 [](char c) { return c == 'D' || c == 'd' ? 'e' : c; });
  const char* copy_end = copy.data() + length;
  const auto result = std::from_chars(copy.data(), copy_end, value);
  if (result.ec == std::errc::invalid_argument)
    return nullptr;
  if (result.ec == std::errc::result_out_of_range)
    value = std::strtod(copy.data(), nullptr);
  return begin + (result.ptr - copy.data());
}

bool isNoDataWord(std::string_view field) {
  static constexpr std::array<std::string_view, 17> words = {"undef", "undefined", "null", "<null>", "(null)", "\\n", "none", "na",   "n/a",
                                                             "#n/a",  "nodata",    "no_data", "void", "missing", "-",   "--",   "?"};
  if (field.find_first_not_of('*') == std::string_view::npos) // nothing, or what Fortran writes for a number that does not fit its field
    return true;
  if (field.empty() || field.size() > 12)
    return false;
  const std::string lower = toLower(field);
  const std::string_view unsigned_part = std::string_view(lower).substr(lower.front() == '-' ? 1 : 0);
  for (const std::string_view unreal : {"1.#ind", "1.#qnan", "1.#snan", "1.#inf"}) // what Windows writes
    if (unsigned_part.substr(0, unreal.size()) == unreal)
      return true;
  return std::find(words.begin(), words.end(), lower) != words.end();
}

template <typename Number>
void appendShortest(std::string& text, Number value) {
  std::array<char, 64> digits{};
  const Number size = std::abs(value);
  const bool usual = size == 0 || (size >= Number(1e-7) && size < Number(1e17));
  const auto format = usual ? std::chars_format::fixed : std::chars_format::scientific;
  const auto result = std::to_chars(digits.data(), digits.data() + digits.size(), value, format);
  text.append(digits.data(), result.ptr);
}

/// Most coordinates have few decimals. With at most 15 digits a decimal that reads back as the number is the only one so
/// short, so it is the shortest.
/// \returns false if the number needs more than six decimals or 15 digits
bool appendFewDecimals(std::string& text, double value) {
  constexpr double unit = 1e6;
  constexpr std::int64_t whole_unit = 1000000;
  const double size = std::abs(value);
  if (!(size < 1e9))
    return false;
  const auto units = static_cast<std::int64_t>(size * unit + 0.5);
  if (static_cast<double>(units) / unit != size)
    return false;
  std::array<char, 24> digits{};
  char* end = digits.data();
  if (std::signbit(value))
    *end++ = '-';
  end = std::to_chars(end, digits.data() + digits.size(), units / whole_unit).ptr;
  std::int64_t fraction = units % whole_unit;
  if (fraction != 0) {
    *end = '.';
    for (char* place = end + 6; place != end; --place, fraction /= 10)
      *place = static_cast<char>('0' + fraction % 10);
    for (end += 7; end[-1] == '0';)
      --end;
  }
  text.append(digits.data(), end);
  return true;
}

} // namespace

const char* parseNumber(const char* begin, const char* end, double& value) {
  if (begin != end && *begin == '+' && begin + 1 != end && begin[1] != '-')
    ++begin;
  const auto result = std::from_chars(begin, end, value);
  const bool fortran = result.ptr != end && (*result.ptr == 'D' || *result.ptr == 'd');
  if (result.ec == std::errc() && !fortran)
    return result.ptr;
  if (result.ec == std::errc::invalid_argument)
    return nullptr;
  return parseUnusualNumber(begin, end, value);
}

bool parseField(std::string_view field, double& value) {
  const char* end = field.data() + field.size();
  if (!field.empty() && parseNumber(field.data(), end, value) == end)
    return true;
  if (!isNoDataWord(field))
    return false;
  value = std::numeric_limits<double>::quiet_NaN();
  return true;
}

bool parseInteger(std::string_view field, std::int64_t& value) {
  if (!field.empty() && field.front() == '+')
    field.remove_prefix(1);
  const char* end = field.data() + field.size();
  const auto result = std::from_chars(field.data(), end, value);
  return result.ec == std::errc() && result.ptr == end;
}

void appendNumber(std::string& text, double value) {
  if (!appendFewDecimals(text, value))
    appendShortest(text, value);
}

void appendNumber(std::string& text, float value) {
  appendShortest(text, value);
}

void appendNumber(std::string& text, std::int64_t value) {
  std::array<char, 24> digits{};
  const auto result = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  text.append(digits.data(), result.ptr);
}

std::string toLower(std::string_view text) {
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return lower;
}

std::string_view trim(std::string_view text) {
  const auto begin = text.find_first_not_of(" \t\r\n");
  if (begin == std::string_view::npos)
    return {};
  return text.substr(begin, text.find_last_not_of(" \t\r\n") - begin + 1);
}

} // namespace graben
