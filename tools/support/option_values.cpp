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

} // namespace

const OptionValues::Entry& OptionValues::entry(const std::string& name) const {
  const auto found = entries_.find(name);
  if (found == entries_.end())
    throw std::logic_error("option --" + name + " was never declared");
  return found->second;
}

void OptionValues::refuse(const std::string& name, const std::string& why, std::size_t which) const {
  const Entry& e = entry(name);
  const std::string where = which < e.where.size() ? e.where[which] : "";
  const std::string value = which < e.values.size() ? e.values[which] : "";
  throw UsageError(where + "option --" + name + ": '" + value + "' " + why);
}

double OptionValues::numberIn(const std::string& name, const std::string& text, std::size_t which) const {
  const char* begin = text.data();
  const char* end = begin + text.size();
  if (begin != end && *begin == '+' && (begin + 1 == end || begin[1] != '-'))
    ++begin;
  double value = 0.0;
  const auto result = std::from_chars(begin, end, value);
  if (begin == end || result.ec != std::errc() || result.ptr != end || !std::isfinite(value))
    refuse(name, "is not a number", which);
  return value;
}

std::vector<double> OptionValues::numbersIn(const std::string& name, std::size_t which, std::size_t count) const {
  const std::string& text = entry(name).values[which];
  std::vector<double> numbers;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    numbers.push_back(numberIn(name, text.substr(begin, end - begin), which));
    begin = end + 1;
  }
  if (count != 0 && numbers.size() != count)
    refuse(name, "is not " + (count == 1 ? "one number" : std::to_string(count) + " numbers separated by commas"), which);
  return numbers;
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
  const double value = numberIn(name, e.values.front(), 0);
  if (value < low || value > high) {
    if (high == std::numeric_limits<double>::max())
      refuse(name, "is not at least " + shown(low));
    if (low == -std::numeric_limits<double>::max())
      refuse(name, "is not at most " + shown(high));
    refuse(name, "is not between " + shown(low) + " and " + shown(high));
  }
  return value;
}

long long OptionValues::integer(const std::string& name, long long low, long long high) const {
  constexpr double kExact =
      9007199254740992.0; // 2^53, the largest range in which every whole number is a double
  const double value = number(name, std::max(static_cast<double>(low), -kExact),
                              std::min(static_cast<double>(high), kExact));
  if (value != std::floor(value))
    refuse(name, "is not a whole number");
  return static_cast<long long>(value);
}

std::vector<double> OptionValues::numbers(const std::string& name, std::size_t count) const {
  const Entry& e = entry(name);
  return e.values.empty() ? std::vector<double>() : numbersIn(name, 0, count);
}

std::vector<std::vector<double>> OptionValues::numberLists(const std::string& name,
                                                           std::size_t count) const {
  std::vector<std::vector<double>> lists;
  for (std::size_t i = 0; i < entry(name).values.size(); ++i)
    lists.push_back(numbersIn(name, i, count));
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
  refuse(name, "is not one of " + listed);
}

} // namespace graben
