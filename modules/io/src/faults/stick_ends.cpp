#include "faults/stick_ends.h"

#include "content/line_reader.h"
#include "content/no_data.h"
#include "content/numbers.h"

#include <algorithm>
#include <cmath>

namespace graben {
namespace {

bool isEmptyRow(std::string_view line) {
  return line.find_first_not_of(" \t\r,;") == std::string_view::npos;
}

bool isZero(const Vector3& point) {
  return point.isZero(0.0);
}

/// The first three numbers in a row.
bool firstNumbers(const std::vector<std::string_view>& fields, Vector3& point) {
  Eigen::Index found = 0;
  for (std::size_t i = 0; i < fields.size() && found < 3; ++i)
    found += !fields[i].empty() && parseField(fields[i], point[found]) ? 1 : 0;
  return found == 3;
}

/// The last three of the first four numbers too: a number may stand before x.
bool numbersBehindFirst(const std::vector<std::string_view>& fields, Vector3& point) {
  return fields.size() > 3 && firstNumbers({fields.begin() + 1, fields.end()}, point);
}

} // namespace

StickEnds::StickEnds(const TextLayout& layout, std::string_view body)
    : delimiter_(layout.delimiter) {
  constexpr std::size_t no_chance = 2;
  LineReader reader(body);
  std::string_view line;
  std::vector<std::string_view> fields;
  std::size_t zeros = 0;
  bool any = false;
  bool empty = false;
  bool text = false;
  while (reader.next(line)) {
    if (isEmptyRow(line)) {
      empty = any;
      continue;
    }
    if (isText(line)) {
      certain_ |= trim(line).substr(0, 1) == ">";
      text = any;
      continue;
    }
    certain_ |= empty;
    texts_ |= text;
    splitFields(line, delimiter_, fields);
    Vector3 point;
    if (firstNumbers(fields, point)) {
      zeros += isZero(point) ? 1 : 0;
      certain_ |= any && isEnd(point);
    }
    if (numbersBehindFirst(fields, point))
      certain_ |= any && !isZero(point) && isEnd(point);
    any = true;
  }
  zeros_end_ = zeros >= no_chance;
  certain_ |= zeros_end_;
}

bool StickEnds::takeTexts() {
  texts_end_ = texts_;
  return texts_;
}

bool StickEnds::isText(std::string_view line) const {
  line = trim(line);
  double value = 0.0;
  if (isPassedOver(line) || line.substr(0, 1) == ">")
    return true;
  std::vector<std::string_view> fields;
  splitFields(line, delimiter_, fields);
  const auto numbers = std::count_if(fields.begin(), fields.end(), [&](std::string_view f) {
    return !f.empty() && parseField(f, value);
  });
  return numbers < 3 && !fields.empty() &&
         !(parseField(fields.front(), value) && std::isfinite(value));
}

bool StickEnds::isEnd(std::string_view line) const {
  return isEmptyRow(line) || trim(line).substr(0, 1) == ">" || (texts_end_ && isText(line));
}

bool StickEnds::isShortEnd(const std::vector<std::string_view>& fields) const {
  Vector3 point;
  return fields.size() == 3 && firstNumbers(fields, point) && isEnd(point);
}

bool StickEnds::isEnd(const Vector3& point) const {
  if (isZero(point))
    return zeros_end_;
  const auto none = [](double v) { return isNullValue(v); };
  return (none(point.x()) && none(point.y()) && none(point.z())) ||
         (point.x() == point.y() && point.x() == point.z() && isNullCode(point.x()));
}

} // namespace graben
