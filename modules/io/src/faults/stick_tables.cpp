// Fault sticks as rows x y z: ended by 999 999 999, an empty row or `>`, or told apart by columns of names and numbers.
#include "content/line_reader.h"
#include "content/no_data.h"
#include "content/numbers.h"
#include "faults/fault_formats.h"
#include "faults/stick_builder.h"
#include "faults/stick_columns.h"
#include "faults/stick_ends.h"
#include "faults/stick_turns.h"
#include "tables/column_names.h"
#include "tables/plain_table.h"
#include "tables/text_layout.h"

#include "graben/core/errors.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace graben {
namespace {

constexpr std::size_t most_header_lines = 1000;
constexpr std::size_t most_quoted = 60;
constexpr std::size_t rows_looked_at = 2000;

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

/// x and y as inline and crossline would be.
bool areWholeAndSmall(const TableSample& sample, const std::vector<int>& place) {
  constexpr double most = 1e5;
  constexpr std::size_t fewest = 8;
  const auto is = [&](int c) {
    const SampledColumn& column = sample.columns[static_cast<std::size_t>(c)];
    return column.integral && column.low > 0.0 && column.high < most;
  };
  const auto there = [&](int c) { return static_cast<std::size_t>(c) < sample.columns.size(); };
  return sample.rows >= fewest && std::all_of(place.begin(), place.end(), there) &&
         is(place[0]) && is(place[1]) && !sample.columns[static_cast<std::size_t>(place[2])].integral;
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

  /// A note for every fault of the file.
  void note(std::string text) { builder_.note(std::move(text)); }

  std::vector<FaultInput> read() {
    settle();
    LineReader reader(layout_.body, layout_.first_line);
    std::string_view line;
    while (reader.next(line) && !(cut_ && reader.rest().empty()))
      add(line, reader.number());
    const bool cut = !layout_.body.empty() && layout_.body.back() != '\n' && terminated_ && builder_.isOpen();
    builder_.end();
    if (columns_.name >= 0)
      builder_.joinNumberedNames();
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
    ends_ = StickEnds(layout_, layout_.body);
    columns_ = findStickColumns(layout_, sample, ends_.certain());
    if (!columns_.doubt.empty())
      fail(layout_.first_line, "the columns of the sticks are not certain: " + columns_.doubt +
                                   "; write a header with the names X,Y,Z,stick (and name, node), or sticks as x y z, each ended by 999 999 999");
    chooseName(sample);
    if (layout_.columns_in_row > 3)
      builder_.note(columnsTaken());
    const bool told_apart = !columns_.sticks.empty() || columns_.node >= 0 || columns_.flag >= 0 || columns_.name >= 0;
    if (!ends_.certain() && !told_apart && ends_.takeTexts())
      builder_.note("rows of text taken for ends of sticks");
    whole_ = areWholeAndSmall(sample, columns_.place);
    cut_ = isLastRowCut(layout_.body, layout_.delimiter, columns_.place[2]);
  }

  /// Of several columns of texts without names the one is taken that several sticks have in common.
  void chooseName(const TableSample& sample) {
    if (columns_.name < 0 || !layout_.names.empty())
      return;
    for (std::size_t c = 0; c < sample.columns.size(); ++c) {
      std::map<std::string, std::set<std::string>, std::less<>> sticks_of_name;
      LineReader reader(layout_.body);
      std::string_view line;
      for (std::size_t rows = 0; sample.columns[c].numbers == 0 && rows < rows_looked_at && reader.next(line); ++rows) {
        splitFields(line, layout_.delimiter, fields_);
        std::string key;
        for (const int stick : columns_.sticks)
          key += (static_cast<std::size_t>(stick) < fields_.size() ? std::string(fields_[static_cast<std::size_t>(stick)]) : std::string()) + '\x1f';
        if (!ends_.isEnd(line) && !isPassedOver(line) && c < fields_.size())
          sticks_of_name[std::string(fields_[c])].insert(key);
      }
      const bool shared = std::any_of(sticks_of_name.begin(), sticks_of_name.end(), [](const auto& entry) { return entry.second.size() > 1; });
      if (shared) {
        columns_.name = static_cast<int>(c);
        return;
      }
    }
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

  void add(std::string_view line, std::size_t number) {
    if (ends_.isEnd(line)) {
      builder_.end();
      return;
    }
    if (isPassedOver(line))
      return;
    splitFields(line, layout_.delimiter, fields_);
    Vector3 point;
    if (!placeOf(point) && !ends_.isShortEnd(fields_))
      fail(number, "no row x y z of a fault stick: '" + std::string(trim(line).substr(0, most_quoted)) + "'");
    if (ends_.isShortEnd(fields_) || ends_.isEnd(point)) {
      terminated_ = true;
      builder_.end();
      return;
    }
    key_.clear();
    for (const int stick : columns_.sticks)
      (key_ += field(stick)) += '\x1f';
    double flag = 0.0;
    if (columns_.flag >= 0 && parseField(field(columns_.flag), flag) && flag == columns_.begin)
      builder_.end();
    double node = std::nan("");
    if (columns_.node >= 0)
      parseField(field(columns_.node), node);
    builder_.add(std::string(field(columns_.name)), columns_.sticks.empty() ? std::string_view{} : std::string_view(key_), node, point);
  }

  /// What the row holds in a column; nothing where it has none.
  std::string_view field(int column) const {
    return column >= 0 && static_cast<std::size_t>(column) < fields_.size() ? fields_[static_cast<std::size_t>(column)] : std::string_view{};
  }

  bool placeOf(Vector3& point) const {
    for (Eigen::Index k = 0; k < 3; ++k) {
      const int column = columns_.place[static_cast<std::size_t>(k)];
      if (static_cast<std::size_t>(column) >= fields_.size() || !parseField(field(column), point[k]))
        return false;
    }
    return true;
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
    if (whole_)
      fault.warnings.push_back("x and y of the sticks in " + path_ + " are small whole numbers: if they are inline and crossline, export x and y");
    if (cut_)
      fault.warnings.push_back(cutRowWarning(path_));
    const auto& sticks = std::get<std::vector<FaultStick>>(fault.geometry);
    if (sticks.size() == 1 && columns_.sticks.empty() && columns_.node < 0 && columns_.flag < 0)
      judgeList(fault, sticks.front().points);
  }

  /// What a list without any end of a stick is.
  static void judgeList(FaultInput& fault, const Points& list) {
    std::vector<FaultStick> sticks;
    for (Points& points : sticksOfTurns(list))
      sticks.push_back({std::move(points)});
    if (!sticks.empty()) {
      fault.notes.push_back(fault.name + " is a list without ends of sticks: " + std::to_string(sticks.size()) +
                            " sticks told apart where z turns back");
      fault.geometry = std::move(sticks);
    } else if (runsToAndFro(list)) {
      fault.notes.push_back(fault.name + " is a list that runs to and fro without ends of sticks: taken for points of the fault");
      TriangleMesh mesh;
      mesh.vertices = list;
      fault.geometry = std::move(mesh);
    } else {
      fault.notes.push_back(fault.name + " is one list of points without any end of line");
    }
  }

  const std::string& path_;
  TextLayout layout_;
  StickColumns columns_;
  StickEnds ends_;
  bool cut_ = false;   ///< the last row is, which is left out
  bool whole_ = false; ///< x and y are, as inline and crossline
  StickBuilder builder_;
  bool terminated_ = false;
  std::vector<std::string_view> fields_;
  std::string key_;
};

} // namespace

std::vector<FaultInput> readLineFaults(std::string_view text, const std::string& path) {
  std::string plain;
  std::vector<std::string> notes;
  text = plainTable(text, path, plain, notes);
  StickTableReader reader(text, path);
  for (std::string& note : notes)
    reader.note(std::move(note));
  return reader.read();
}

} // namespace graben
