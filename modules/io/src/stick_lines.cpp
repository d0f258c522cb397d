// IRAP/RMS lines (.pol) and CPS-3 lines.
#include "fault_formats.h"

#include "file_content.h"
#include "line_reader.h"
#include "no_data.h"
#include "numbers.h"
#include "table_reader.h"

#include "graben/core/errors.h"

#include <algorithm>

namespace graben {
namespace {

constexpr std::size_t most_quoted = 60;

/// Lines in the making: points are added to the last one until it is ended.
class LineBuilder {
public:
  void add(const Vector3& point) {
    if (ended_)
      lines_.emplace_back();
    ended_ = false;
    lines_.back().push_back(point);
  }
  void end() { ended_ = true; }
  std::vector<Points> take() { return std::move(lines_); }

private:
  std::vector<Points> lines_;
  bool ended_ = true;
};

char delimiterOf(std::string_view row) {
  for (const char c : {';', ','})
    if (row.find(c) != std::string_view::npos)
      return c;
  return ' ';
}

Vector3 pointOf(std::string_view line, const std::string& path, std::size_t number) {
  TableLayout<3> layout;
  layout.delimiter = delimiterOf(line);
  layout.columns = {0, 1, 2};
  Vector3 point;
  if (!parseTableRow<3>(line, layout, point))
    throw ParseError(path, number,
                     "no row x y z of a fault stick: '" +
                         std::string(trim(line).substr(0, most_quoted)) + "'");
  return point;
}

bool isHeader(std::string_view line) {
  double value = 0.0;
  std::vector<std::string_view> words;
  splitWords(line, words);
  return !words.empty() &&
         parseNumber(words[0].data(), words[0].data() + words[0].size(), value) == nullptr;
}

std::vector<FaultInput> oneFault(std::vector<Points> lines, const std::string& path) {
  FaultInput fault;
  fault.name = stemOf(path);
  fault.source = path;
  std::vector<FaultStick> sticks = sticksFromLines(std::move(lines), fault.notes);
  if (sticks.empty())
    throw ParseError(path, 0, "holds no fault stick with two points or more");
  fault.geometry = std::move(sticks);
  std::vector<FaultInput> faults;
  faults.push_back(std::move(fault));
  return faults;
}

} // namespace

std::vector<FaultStick> sticksFromLines(std::vector<Points> lines,
                                        std::vector<std::string>& notes) {
  std::vector<FaultStick> sticks;
  std::size_t null_points = 0;
  std::size_t short_lines = 0;
  Points all;
  for (const Points& line : lines)
    all.insert(all.end(), line.begin(), line.end());
  const std::vector<double> nulls = nullsOf(all, {});
  const auto is_null = [&nulls](const Vector3& p) { return !p.allFinite() || isNullAmong(nulls, p.z()); };
  for (Points& line : lines) {
    const auto end = std::remove_if(line.begin(), line.end(), is_null);
    null_points += static_cast<std::size_t>(line.end() - end);
    line.erase(end, line.end());
    if (line.size() < 2)
      ++short_lines;
    else
      sticks.push_back({std::move(line)});
  }
  if (null_points > 0)
    notes.push_back(std::to_string(null_points) + " stick points without data dropped");
  if (short_lines > 0)
    notes.push_back(std::to_string(short_lines) + " sticks with fewer than two points dropped");
  return sticks;
}

std::vector<FaultInput> readLineFaults(std::string_view text, const std::string& path) {
  LineBuilder builder;
  LineReader reader(text);
  std::string_view line;
  bool any = false;
  bool parted = false;
  while (reader.next(line)) {
    if (trim(line).empty()) {
      parted |= any;
      builder.end();
    } else if (!isPassedOver(line) && (any || !isHeader(line))) {
      const Vector3 point = pointOf(line, path, reader.number());
      any = true;
      if (isTerminator(point)) {
        parted = true;
        builder.end();
      } else {
        builder.add(point);
      }
    }
  }
  if (!any)
    throw ParseError(path, 0, "is no fault: neither a surface nor rows x y z of sticks");
  if (!parted)
    throw ParseError(
        path, 0,
        "is one list of points without any end of line; fault sticks must each be ended by a row "
        "999 999 999 or an empty row");
  return oneFault(builder.take(), path);
}

std::vector<FaultInput> readCps3Faults(std::string_view text, const std::string& path) {
  LineBuilder builder;
  LineReader reader(text);
  std::string_view line;
  while (reader.next(line)) {
    const std::string_view start = trim(line).substr(0, 2);
    if (start == "->")
      builder.end();
    else if (start != "FF" && !isPassedOver(line))
      builder.add(pointOf(line, path, reader.number()));
  }
  return oneFault(builder.take(), path);
}

} // namespace graben
