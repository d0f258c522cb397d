#include "faults/stick_columns.h"

#include "content/numbers.h"
#include "tables/column_names.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace graben {
namespace {

/// How a column of whole numbers goes on from row to row.
struct Course {
  bool whole = false;
  bool constant = false;
  bool runs = false;   ///< stays the same for some rows, then changes
  bool counts = false; ///< mostly grows by one
  bool flags = false;  ///< three numbers: begin of a line, on it, end
};

/// 1 2 2 3 1 2 3: a count of nodes never stays where it is, the middle of a line does.
bool areFlags(const SampledColumn& column) {
  if (!column.whole || column.high - column.low != 2.0 || column.values.empty() || column.values.front() != column.low)
    return false;
  bool stays = false;
  for (std::size_t r = 1; r < column.values.size(); ++r) {
    const double before = column.values[r - 1];
    const double value = column.values[r];
    const bool begins = before == column.high && value == column.low;
    const bool goes_on = before != column.high && value != column.low;
    if (!begins && !goes_on)
      return false;
    stays |= value == before;
  }
  return stays;
}

Course courseOf(const SampledColumn& column) {
  Course course;
  course.whole = column.whole && column.low <= column.high;
  course.constant = course.whole && column.constant();
  std::size_t same = 0;
  std::size_t next = 0;
  for (std::size_t r = 1; r < column.values.size(); ++r) {
    same += column.values[r] == column.values[r - 1] ? 1 : 0;
    next += column.values[r] == column.values[r - 1] + 1.0 ? 1 : 0;
  }
  const std::size_t steps = column.values.empty() ? 0 : column.values.size() - 1;
  course.runs = course.whole && 3 * same >= steps;
  course.counts = course.whole && 2 * next >= steps;
  course.flags = areFlags(column);
  return course;
}

/// Beside traces a line is one of the survey, not of a fault.
std::vector<std::string> withoutLines(std::vector<std::string> names) {
  for (std::string& name : names)
    if (toLower(trim(name)).rfind("line", 0) == 0)
      name.clear();
  return names;
}

class StickTable {
public:
  StickTable(const TextLayout& layout, const TableSample& sample)
      : layout_(layout)
      , sample_(sample) {}

  StickColumns byName(bool parted) const {
    StickColumns columns;
    const auto& names = layout_.names;
    const int shift = names.size() + 1 == layout_.columns_in_row ? 1 : 0;
    for (const int c : findCoordinateColumns(names)) {
      if (c < 0)
        columns.doubt = "the header names x and y but no z";
      else
        columns.place.push_back(c + shift);
    }
    const auto find = [&](ColumnRole role) { return findColumn(names, role) < 0 ? -1 : findColumn(names, role) + shift; };
    columns.name = shift > 0 ? 0 : find(ColumnRole::Fault);
    columns.node = find(ColumnRole::Node);
    const bool traces = find(ColumnRole::Crossline) >= 0;
    const int stick = findColumn(traces ? withoutLines(names) : names, ColumnRole::Stick);
    if (stick >= 0)
      columns.sticks.push_back(stick + shift);
    else if (traces && columns.name < 0 && columns.node < 0)
      columns.doubt = "the header names traces, as that of a horizon along lines does";
    if (shift > 0 && !sample_.columns.empty() && sample_.columns[0].counter)
      columns.name = -1; // numbers of the rows
    if (const std::string other = otherNameForZ(names); !other.empty() && columns.place.size() == 3)
      columns.doubt = "both '" + names[static_cast<std::size_t>(columns.place[2] - shift)] + "' and '" + other + "' may be z";
    if (!parted)
      takeNumberedRuns(columns, shift);
    return columns;
  }

  StickColumns byContent(bool parted) {
    StickColumns columns;
    for (std::size_t c = 0; c < sample_.columns.size(); ++c) {
      if (sample_.isNumber(c) || sample_.columns.size() == 3)
        numbers_.push_back(c);
      else if (columns.name < 0 && sample_.columns[c].numbers == 0)
        columns.name = static_cast<int>(c);
    }
    while (numbers_.size() > 3 && (takeId(true, columns) || takeStickAndNode(columns) || takeLineNumbers() || takeId(false, columns))) {
    }
    if (numbers_.size() > 3)
      columns.doubt = "x, y and z cannot be told from other columns of numbers";
    if (numbers_.size() < 3)
      columns.doubt = "fewer than three columns hold numbers";
    columns.place.assign(numbers_.begin(), numbers_.end());
    std::reverse(columns.sticks.begin(), columns.sticks.end());
    if (!parted && columns.sticks.empty() && columns.node < 0 && columns.flag < 0 && columns.name < 0 && sample_.columns.size() > 3)
      columns.doubt = "no column tells the sticks apart";
    return columns;
  }

private:
  /// Where no name says which column tells the sticks: one whose number stays along some rows and then changes for good (`id`, `fid`, `group`).
  void takeNumberedRuns(StickColumns& columns, int shift) const {
    if (!columns.sticks.empty() && static_cast<std::size_t>(columns.sticks[0]) >= sample_.columns.size())
      return; // rows are shorter than the header
    if (!columns.sticks.empty() && !sample_.columns[static_cast<std::size_t>(columns.sticks[0])].constant())
      return;
    for (std::size_t c = 0; c < sample_.columns.size(); ++c) {
      const int column = static_cast<int>(c);
      const bool taken = std::count(columns.place.begin(), columns.place.end(), column) > 0 || column == columns.name || column == columns.node;
      const auto named = c - static_cast<std::size_t>(shift);
      const std::vector<std::string> name = {column >= shift && named < layout_.names.size() ? layout_.names[named] : std::string()};
      const bool of_survey = findColumn(name, ColumnRole::Inline) >= 0 || findColumn(name, ColumnRole::Crossline) >= 0;
      if (!taken && !of_survey && areRuns(sample_.columns[c])) {
        columns.sticks.push_back(column);
        return;
      }
    }
  }

  /// Whole numbers of which none comes back once it has changed.
  static bool areRuns(const SampledColumn& column) {
    std::set<double> seen;
    std::size_t runs = 0;
    for (std::size_t r = 0; r < column.values.size(); ++r)
      if (r == 0 || column.values[r] != column.values[r - 1]) {
        ++runs;
        seen.insert(column.values[r]);
      }
    return column.integral && !column.constant() && runs == seen.size() && 2 * runs <= column.values.size();
  }

  /// The first two columns, of which the second counts from the start again wherever the first changes.
  bool takeStickAndNode(StickColumns& columns) {
    if (numbers_.size() < 5 || !columns.sticks.empty() || columns.node >= 0)
      return false;
    const SampledColumn& stick = sample_.columns[numbers_[0]];
    const SampledColumn& node = sample_.columns[numbers_[1]];
    if (!stick.whole || !node.whole || stick.constant() || node.constant() || node.low < 0.0 || node.low > 1.0)
      return false;
    for (std::size_t r = 1; r < node.values.size(); ++r) {
      const bool again = stick.values[r] != stick.values[r - 1];
      if (again ? node.values[r] != node.low : node.values[r] != node.values[r - 1] + 1.0)
        return false;
    }
    columns.sticks.push_back(static_cast<int>(numbers_[0]));
    columns.node = static_cast<int>(numbers_[1]);
    numbers_.erase(numbers_.begin(), numbers_.begin() + 2);
    return true;
  }

  /// Takes the last or first column of numbers for one that tells sticks or nodes.
  bool takeId(bool last, StickColumns& columns) {
    const std::size_t c = last ? numbers_.back() : numbers_.front();
    const Course course = courseOf(sample_.columns[c]);
    if (course.flags && columns.flag < 0) {
      columns.flag = static_cast<int>(c);
      columns.begin = sample_.columns[c].low;
    } else if (course.runs || course.constant) {
      if (!course.constant || columns.sticks.empty())
        columns.sticks.push_back(static_cast<int>(c));
    } else if (course.counts && columns.node < 0) {
      columns.node = static_cast<int>(c);
    } else {
      return false;
    }
    numbers_.erase(last ? numbers_.end() - 1 : numbers_.begin());
    return true;
  }

  bool takeLineNumbers() {
    if (numbers_.size() < 5)
      return false;
    for (std::size_t i = 0; i + 1 < numbers_.size(); ++i)
      for (std::size_t k = 0; k + 1 < numbers_.size(); ++k) {
        const bool whole = sample_.columns[numbers_[i]].whole && sample_.columns[numbers_[i + 1]].whole;
        if ((k > i + 1 || i > k + 1) && whole && followEvenly(sample_, numbers_[i], numbers_[i + 1], numbers_[k], numbers_[k + 1])) {
          numbers_.erase(numbers_.begin() + static_cast<std::ptrdiff_t>(i), numbers_.begin() + static_cast<std::ptrdiff_t>(i) + 2);
          return true;
        }
      }
    return false;
  }

  const TextLayout& layout_;
  const TableSample& sample_;
  std::vector<std::size_t> numbers_;
};

} // namespace

StickColumns findStickColumns(const TextLayout& layout, const TableSample& sample, bool parted) {
  const auto named = findCoordinateColumns(layout.names);
  StickTable table(layout, sample);
  return named[0] >= 0 && named[1] >= 0 ? table.byName(parted) : table.byContent(parted);
}

} // namespace graben
