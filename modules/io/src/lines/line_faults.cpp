// Fault sticks in formats of their own: CPS-3 lines, Surfer BLN, IESX.
#include "content/line_reader.h"
#include "content/numbers.h"
#include "faults/fault_formats.h"
#include "faults/stick_builder.h"
#include "lines/iesx.h"
#include "tables/table_reader.h"

#include "graben/core/errors.h"

#include <algorithm>

namespace graben {
namespace {

constexpr std::size_t most_quoted = 60;

std::string quoted(std::string_view line) {
  return "'" + std::string(trim(line).substr(0, most_quoted)) + "'";
}

std::vector<std::string_view> fieldsOf(std::string_view line) {
  std::vector<std::string_view> fields;
  splitFields(line, line.find(',') != std::string_view::npos ? ',' : ' ', fields);
  return fields;
}

bool pointOf(const std::vector<std::string_view>& fields, Vector3& point) {
  return fields.size() >= 3 && parseField(fields[0], point.x()) && parseField(fields[1], point.y()) && parseField(fields[2], point.z());
}

/// `n[,flag[,name]]` of a BLN file.
bool countOf(const std::vector<std::string_view>& fields, std::int64_t& count) {
  std::int64_t flag = 0;
  double value = 0.0;
  const bool rest = fields.size() < 2 || parseInteger(fields[1], flag) || !parseField(fields[1], value);
  return !fields.empty() && rest && parseInteger(fields[0], count) && count > 0 && (fields.size() != 3 || !parseField(fields[2], value));
}

} // namespace

std::vector<FaultInput> readCps3Faults(std::string_view text, const std::string& path) {
  StickBuilder builder(path);
  LineReader reader(text);
  std::string_view line;
  while (reader.next(line)) {
    const std::string_view start = trim(line).substr(0, 2);
    if (start == "->") {
      builder.end();
    } else if (start != "FF" && !isPassedOver(line)) {
      Vector3 point;
      if (!pointOf(fieldsOf(line), point))
        throw ParseError(path, reader.number(), "no row x y z of a fault stick: " + quoted(line));
      builder.add({}, {}, std::nan(""), point);
    }
  }
  return builder.take();
}

bool isBln(std::string_view text) {
  LineReader reader(text);
  std::string_view line;
  while (reader.next(line) && trim(line).empty()) {
  }
  std::int64_t count = 0;
  if (!countOf(fieldsOf(line), count) || fieldsOf(line).size() > 3)
    return false;
  Vector3 point;
  for (std::int64_t i = 0; i < std::min<std::int64_t>(count, 3); ++i)
    if (!reader.next(line) || fieldsOf(line).size() < 2 || fieldsOf(line).size() > 3 || !parseField(fieldsOf(line)[0], point.x()) ||
        !parseField(fieldsOf(line)[1], point.y()))
      return false;
  return true;
}

std::vector<FaultInput> readBlnFaults(std::string_view text, const std::string& path) {
  StickBuilder builder(path);
  LineReader reader(text);
  std::string_view line;
  while (reader.next(line)) {
    if (trim(line).empty())
      continue;
    const auto head = fieldsOf(line);
    std::int64_t count = 0;
    if (!countOf(head, count))
      throw ParseError(path, reader.number(), "no head n[,flag[,name]] of a line of a BLN file: " + quoted(line));
    const std::string name = head.size() > 2 ? std::string(head[2]) : "";
    const std::size_t first = reader.number();
    for (std::int64_t i = 0; i < count; ++i) {
      Vector3 point;
      if (!reader.next(line))
        throw ParseError(path, first,
                         "the file is cut short: this line has " + std::to_string(count) + " points, the file holds " + std::to_string(i));
      if (!pointOf(fieldsOf(line), point))
        throw ParseError(path, reader.number(), "no row x,y,z of a fault stick (a BLN file of a map has no z): " + quoted(line));
      builder.add(name, {}, std::nan(""), point);
    }
    builder.end();
  }
  return builder.take();
}

namespace {

/// Code 6 begins a line, 7 goes on, 8 ends it; other codes say nothing, and the number of the segment tells the lines.
void addSticks(const IesxProfile& profile, StickBuilder& builder) {
  constexpr std::int64_t begin = 6, end = 8;
  const auto all = [&](auto test) { return std::all_of(profile.rows.begin(), profile.rows.end(), test); };
  const bool coded = all([](const IesxRow& row) { return row.code >= begin && row.code <= end; });
  const IesxRow* before = nullptr;
  std::size_t stick = 0;
  for (const IesxRow& row : profile.rows) {
    const bool other = before == nullptr || before->block != row.block || before->segment != row.segment;
    stick += other || (coded && (row.code == begin || before->code == end)) ? 1 : 0;
    before = &row;
    const std::string key = std::to_string(row.block) + " " + std::to_string(coded ? static_cast<std::int64_t>(stick) : row.segment);
    builder.add(profile.name, key, std::nan(""), row.point);
  }
}

} // namespace

std::vector<FaultInput> readIesxFaults(std::string_view text, const std::string& path) {
  StickBuilder builder(path);
  std::vector<IesxProfile> profiles = readIesx(text, path);
  const bool any_fault = std::any_of(profiles.begin(), profiles.end(), [](const IesxProfile& p) { return p.fault; });
  for (const IesxProfile& profile : profiles)
    if (profile.fault || !any_fault)
      addSticks(profile, builder);
  return builder.take();
}

} // namespace graben
