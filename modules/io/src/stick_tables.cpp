// Fault sticks as rows x y z: ended by 999 999 999, an empty row or `>`, or told apart by columns of names and numbers.
#include "column_names.h"
#include "fault_formats.h"
#include "line_reader.h"
#include "no_data.h"
#include "numbers.h"
#include "stick_builder.h"
#include "stick_columns.h"
#include "text_layout.h"

#include "graben/core/errors.h"

#include <algorithm>
#include <cmath>

namespace graben {
namespace {

constexpr std::size_t most_header_lines = 1000;
constexpr std::size_t most_quoted = 60;

char delimiterOf(std::string_view row) {
  for (const char c : {';', ','})
    if (row.find(c) != std::string_view::npos)
      return c;
  return row.find('\t') != std::string_view::npos && row.find("\t\t") == std::string_view::npos && trim(row).find(' ') == std::string_view::npos
             ? '\t'
             : ' ';
}

std::size_t numbersIn(const std::vector<std::string_view>& fields) {
  return static_cast<std::size_t>(std::count_if(fields.begin(), fields.end(), [](std::string_view field) {
    double value = 0.0;
    return !field.empty() && parseField(field, value);
  }));
}

bool isMark(std::string_view line) {
  return trim(line).substr(0, 1) == ">";
}

/// What stands before the first row of numbers.
TextLayout layoutOf(std::string_view text) {
  TextLayout layout;
  HeaderNames header;
  LineReader reader(text);
  std::string_view line;
  std::vector<std::string_view> fields;
  layout.body = reader.rest();
  for (std::size_t lines = 0; lines < most_header_lines && reader.next(line); ++lines) {
    if (isMark(line))
      continue;
    if (!isPassedOver(line) && !header.insideBlock()) {
      layout.delimiter = delimiterOf(line);
      splitFields(line, layout.delimiter, fields);
      if (numbersIn(fields) >= 3) {
        layout.columns_in_row = fields.size();
        layout.first_line = reader.number();
        layout.names = header.names();
        layout.nulls = header.nulls();
        return layout;
      }
    }
    header.add(line);
    layout.body = reader.rest();
  }
  layout.columns_in_row = 0;
  return layout;
}

class StickTableReader {
public:
  StickTableReader(std::string_view text, const std::string& path)
      : path_(path)
      , layout_(layoutOf(text))
      , builder_(path) {
    if (layout_.columns_in_row == 0)
      throw ParseError(path_, 0, "is no fault: neither a surface nor rows x y z of sticks");
  }

  std::vector<FaultInput> read() {
    settle();
    LineReader reader(layout_.body, layout_.first_line);
    std::string_view line;
    while (reader.next(line))
      add(line, reader.number());
    const bool cut = !layout_.body.empty() && layout_.body.back() != '\n' && terminated_ && builder_.isOpen();
    builder_.end();
    std::vector<FaultInput> faults = builder_.take();
    takeNameOfZ(faults);
    for (FaultInput& fault : faults)
      judge(fault, cut && &fault == &faults.back());
    return faults;
  }

private:
  [[noreturn]] void fail(std::size_t number, const std::string& message) const { throw ParseError(path_, number, message); }

  void settle() {
    const TableSample sample = sampleTable(layout_.body, layout_.delimiter, layout_.columns_in_row);
    columns_ = findStickColumns(layout_, sample, isParted());
    if (!columns_.doubt.empty())
      fail(layout_.first_line, "the columns of the sticks are not certain: " + columns_.doubt +
                                   "; write a header with the names X,Y,Z,stick (and name, node), or sticks as x y z, each ended by 999 999 999");
    if (layout_.columns_in_row > 3)
      builder_.note(columnsTaken());
  }

  std::string columnsTaken() const {
    const auto number = [](int column) { return std::to_string(column + 1); };
    std::string text = "columns " + number(columns_.place[0]) + ", " + number(columns_.place[1]) + ", " + number(columns_.place[2]) + " of " +
                       std::to_string(layout_.columns_in_row) + " taken as x, y, z";
    for (const int stick : columns_.sticks)
      text += ", " + number(stick) + " as stick";
    if (columns_.node >= 0)
      text += ", " + number(columns_.node) + " as node";
    if (columns_.flag >= 0)
      text += ", " + number(columns_.flag) + " as begin and end of sticks";
    if (columns_.name >= 0)
      text += ", " + number(columns_.name) + " as the fault's name";
    return text;
  }

  /// True if rows of their own end the sticks.
  bool isParted() const {
    LineReader reader(layout_.body);
    std::string_view line;
    bool any = false;
    bool empty = false;
    while (reader.next(line)) {
      if (isMark(line) || (any && trim(line).substr(0, 3) == "999" && isEnd(line)))
        return true;
      if (trim(line).empty())
        empty = any;
      else if (empty)
        return true;
      else
        any = true;
    }
    return false;
  }

  static bool isEnd(std::string_view line) {
    std::vector<std::string_view> fields;
    splitFields(line, delimiterOf(line), fields);
    double value = 0.0;
    return fields.size() >= 3 &&
           std::all_of(fields.begin(), fields.begin() + 3, [&](std::string_view f) { return parseField(f, value) && value == 999.0; });
  }

  void add(std::string_view line, std::size_t number) {
    if (trim(line).empty() || isMark(line)) {
      builder_.end();
      return;
    }
    if (isPassedOver(line))
      return;
    if (trim(line).substr(0, 3) == "999" && isEnd(line)) {
      terminated_ = true;
      builder_.end();
      return;
    }
    splitFields(line, layout_.delimiter, fields_);
    const auto text = [&](int column) {
      return column >= 0 && static_cast<std::size_t>(column) < fields_.size() ? fields_[static_cast<std::size_t>(column)] : std::string_view{};
    };
    Vector3 point;
    for (Eigen::Index k = 0; k < 3; ++k) {
      const std::string_view field = text(columns_.place[static_cast<std::size_t>(k)]);
      if (static_cast<std::size_t>(columns_.place[static_cast<std::size_t>(k)]) >= fields_.size() || !parseField(field, point[k]))
        fail(number, "no row x y z of a fault stick: '" + std::string(trim(line).substr(0, most_quoted)) + "'");
    }
    key_.clear();
    for (const int stick : columns_.sticks)
      (key_ += text(stick)) += '\x1f';
    double flag = 0.0;
    if (columns_.flag >= 0 && parseField(text(columns_.flag), flag) && flag == columns_.begin)
      builder_.end();
    double node = std::nan("");
    if (columns_.node >= 0)
      parseField(text(columns_.node), node);
    builder_.add(std::string(text(columns_.name)), columns_.sticks.empty() ? std::string_view{} : std::string_view(key_), node, point);
  }

  void takeNameOfZ(std::vector<FaultInput>& faults) const {
    const std::size_t shift = layout_.names.size() + 1 == layout_.columns_in_row ? 1 : 0;
    const auto z = static_cast<std::size_t>(columns_.place[2]);
    const int sense = z >= shift && z - shift < layout_.names.size() ? senseOfName(layout_.names[z - shift]) : 0;
    if (sense == 0)
      return;
    for (FaultInput& fault : faults) {
      bool positive = false;
      for (const FaultStick& stick : std::get<std::vector<FaultStick>>(fault.geometry))
        for (const Vector3& p : stick.points)
          positive |= p.z() > 0.0;
      fault.z_positive = sense > 0 || !positive ? ZPositive::Up : ZPositive::Down;
    }
  }

  void judge(FaultInput& fault, bool cut) const {
    if (cut)
      fault.warnings.push_back(path_ + ": the last stick has no end and the last row no line end; the file may be cut short");
    const auto& sticks = std::get<std::vector<FaultStick>>(fault.geometry);
    if (sticks.size() == 1 && columns_.sticks.empty() && columns_.node < 0 && columns_.flag < 0)
      fault.notes.push_back(fault.name + " is one list of points without any end of line");
  }

  const std::string& path_;
  TextLayout layout_;
  StickColumns columns_;
  StickBuilder builder_;
  bool terminated_ = false;
  std::vector<std::string_view> fields_;
  std::string key_;
};

} // namespace

std::vector<FaultInput> readLineFaults(std::string_view text, const std::string& path) {
  std::string with_points;
  if (hasDecimalCommas(text)) {
    with_points = withDecimalPoints(text);
    text = with_points;
  }
  return StickTableReader(text, path).read();
}

} // namespace graben
