#include "support/options.h"

#include <charconv>
#include <cmath>

namespace graben {
namespace {

std::string shown(double value) {
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof(buffer), value);
  return std::string(buffer, end.ptr);
}

[[noreturn]] void reject(const std::string& name, const std::string& text,
                         const std::string& wanted) {
  throw UsageError("option --" + name + ": '" + text + "' is not " + wanted);
}

double parseNumber(const std::string& name, const std::string& text) {
  const char* begin = text.data();
  const char* end = begin + text.size();
  if (begin != end && *begin == '+' && (begin + 1 == end || begin[1] != '-'))
    ++begin;
  double value = 0.0;
  const auto result = std::from_chars(begin, end, value);
  if (begin == end || result.ec != std::errc() || result.ptr != end || !std::isfinite(value))
    reject(name, text, "a number");
  return value;
}

std::vector<double> parseNumbers(const std::string& name, const std::string& text,
                                 std::size_t count) {
  std::vector<double> numbers;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    numbers.push_back(parseNumber(name, text.substr(begin, end - begin)));
    begin = end + 1;
  }
  if (count != 0 && numbers.size() != count)
    reject(name, text, std::to_string(count) + " numbers separated by commas");
  return numbers;
}

} // namespace

const OptionValues::Entry& OptionValues::entry(const std::string& name) const {
  const auto found = entries_.find(name);
  if (found == entries_.end())
    throw std::logic_error("option --" + name + " was never declared");
  return found->second;
}

bool OptionValues::has(const std::string& name) const {
  return entry(name).given;
}

const std::string& OptionValues::text(const std::string& name) const {
  static const std::string none;
  const Entry& e = entry(name);
  return e.values.empty() ? none : e.values.front();
}

const std::vector<std::string>& OptionValues::texts(const std::string& name) const {
  return entry(name).values;
}

double OptionValues::number(const std::string& name, double low, double high) const {
  const Entry& e = entry(name);
  if (e.values.empty())
    return 0.0;
  const double value = parseNumber(name, e.values.front());
  if (value < low || value > high) {
    if (high == std::numeric_limits<double>::max())
      reject(name, e.values.front(), "at least " + shown(low));
    if (low == -std::numeric_limits<double>::max())
      reject(name, e.values.front(), "at most " + shown(high));
    reject(name, e.values.front(), "between " + shown(low) + " and " + shown(high));
  }
  return value;
}

long long OptionValues::integer(const std::string& name, long long low, long long high) const {
  constexpr double kExact =
      9007199254740992.0; // 2^53, the largest range in which every whole number is a double
  const double value = number(name, std::max(static_cast<double>(low), -kExact),
                              std::min(static_cast<double>(high), kExact));
  if (value != std::floor(value))
    reject(name, text(name), "a whole number");
  return static_cast<long long>(value);
}

std::vector<double> OptionValues::numbers(const std::string& name, std::size_t count) const {
  const Entry& e = entry(name);
  return e.values.empty() ? std::vector<double>() : parseNumbers(name, e.values.front(), count);
}

std::vector<std::vector<double>> OptionValues::numberLists(const std::string& name,
                                                           std::size_t count) const {
  std::vector<std::vector<double>> lists;
  for (const std::string& value : entry(name).values)
    lists.push_back(parseNumbers(name, value, count));
  return lists;
}

std::size_t OptionValues::choice(const std::string& name,
                                 const std::vector<std::string>& allowed) const {
  std::string listed;
  for (std::size_t i = 0; i < allowed.size(); ++i) {
    if (allowed[i] == text(name))
      return i;
    listed += (i == 0 ? "" : ", ") + allowed[i];
  }
  reject(name, text(name), "one of " + listed);
}

} // namespace graben
