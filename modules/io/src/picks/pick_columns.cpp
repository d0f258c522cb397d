#include "picks/pick_columns.h"

#include "content/line_reader.h"
#include "content/no_data.h"
#include "content/numbers.h"
#include "tables/column_names.h"

#include "graben/core/errors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

namespace graben {
namespace {

constexpr std::size_t fewest_rows = 5; ///< that numbers are judged by
constexpr std::size_t most_horizons = 1000;
constexpr std::size_t most_listed = 12;

std::string listOf(const std::vector<std::string>& items) {
  std::string list;
  for (std::size_t i = 0; i < items.size(); ++i)
    list += (i == 0 ? "" : ", ") + items[i];
  return list;
}

std::string numbersOf(const std::vector<std::size_t>& columns) {
  std::vector<std::string> numbers;
  for (const std::size_t c : columns)
    numbers.push_back(std::to_string(c + 1));
  return listOf(numbers);
}

std::string nameOf(const TextLayout& layout, std::size_t column) {
  const std::size_t shift = layout.shift;
  return column >= shift && column - shift < layout.names.size() ? layout.names[column - shift] : std::string();
}

/// Finds x, y and z among columns without names by what the numbers are.
class UnnamedColumns {
public:
  UnnamedColumns(const TableSample& sample, std::vector<std::string>& notes)
      : sample_(sample)
      , notes_(notes) {
    for (std::size_t c = 0; c < sample.columns.size(); ++c)
      if (sample.isNumber(c) || sample.columns.size() == 3)
        left_.push_back(c);
  }

  /// \returns why the columns are not certain; empty if they are
  std::string settle(std::vector<int>& columns) {
    if (left_.size() > 3 && sample_.rows >= fewest_rows) {
      leaveOutCounter();
      leaveOutNumbersOfLines();
    }
    if (left_.size() < 3)
      return "x, y and z cannot be told from the other columns of numbers";
    const std::string doubt = left_.size() > 3 && sample_.rows >= fewest_rows ? doubtOf() : "";
    columns.assign(left_.begin(), left_.begin() + 3);
    return doubt.empty() ? doubtOfZ() : doubt;
  }

private:
  const SampledColumn& at(std::size_t i) const { return sample_.columns[left_[i]]; }

  void leaveOut(const std::vector<std::size_t>& columns, const std::string& what) {
    for (const std::size_t c : columns)
      left_.erase(std::remove(left_.begin(), left_.end(), c), left_.end());
    notes_.push_back("columns " + numbersOf(columns) + " taken for " + what + " and left out");
  }

  void leaveOutNumbersOfLines() {
    for (std::size_t i = 0; i + 1 < left_.size(); ++i)
      for (std::size_t k = 0; k + 1 < left_.size(); ++k) {
        const bool apart = k > i + 1 || i > k + 1;
        if (!apart || !at(i).integral || !at(i + 1).integral || (at(i).constant() && at(i + 1).constant()))
          continue;
        const bool smaller = at(i).span() + at(i + 1).span() < at(k).span() + at(k + 1).span();
        if (smaller && followEvenly(sample_, left_[i], left_[i + 1], left_[k], left_[k + 1]))
          return leaveOut({left_[i], left_[i + 1]}, "inline and crossline");
      }
  }

  void leaveOutCounter() {
    if (left_.size() > 3 && at(0).counter)
      leaveOut({left_.front()}, "a row number");
    else if (left_.size() > 3 && at(left_.size() - 1).counter)
      leaveOut({left_.back()}, "a row number");
  }

  std::string doubtOf() const {
    const auto later = [&](auto test) {
      for (std::size_t i = 3; i < left_.size(); ++i)
        if (test(at(i)))
          return true;
      return false;
    };
    const auto varies = [](const SampledColumn& c) { return !c.constant() && !c.whole; };
    if (at(2).constant() && later([](const SampledColumn& c) { return !c.constant(); }))
      return "column " + std::to_string(left_[2] + 1) + " holds one number only and others follow";
    if (at(0).whole != at(1).whole)
      return "of the first two columns of numbers only one is whole";
    if (at(2).whole && later(varies))
      return "column " + std::to_string(left_[2] + 1) + " holds whole numbers only, as line, trace or flag, and others follow";
    const double span = std::max(at(0).span(), at(1).span());
    if (at(0).whole && at(1).whole && later([&](const SampledColumn& c) { return c.span() > 3.0 * span; }))
      return "the first two columns hold whole numbers, as inline and crossline, and larger ones follow";
    if (!at(0).constant() && !at(1).constant() && (at(0).span() > 1e4 * at(1).span() || at(1).span() > 1e4 * at(0).span()))
      return "the first two columns of numbers span " + std::to_string(at(0).span()) + " and " + std::to_string(at(1).span());
    return {};
  }

  /// Map coordinates are far from 0 for their width, depths are not.
  std::string doubtOfZ() const {
    constexpr double too_deep = 1e5;
    constexpr double too_far = 20.0;
    double least = std::numeric_limits<double>::infinity();
    std::size_t known = 0;
    for (const double z : at(2).values)
      if (std::isfinite(z) && !isNullValue(z) && !isNullCode(z)) {
        least = std::min(least, std::abs(z));
        ++known;
      }
    if (known < fewest_rows || least < too_deep || least < too_far * std::max(at(0).span(), at(1).span()))
      return {};
    return "column " + std::to_string(left_[2] + 1) + " holds values about " + std::to_string(std::llround(least)) + ", too large for z";
  }

  const TableSample& sample_;
  std::vector<std::string>& notes_;
  std::vector<std::size_t> left_; ///< columns of numbers
};

class ColumnChoice {
public:
  ColumnChoice(TextLayout& layout, const PickFile& file, PickSet& picks)
      : layout_(layout)
      , file_(file)
      , picks_(picks) {}

  void settle() {
    if (!file_.options.columns.empty())
      return takeAsked();
    if (layout_.names_used) {
      leaveOutRowNumbers();
      noteColumns(layout_, pointTableKind(), picks_.notes);
      return;
    }
    refuseOtherNames();
    if (takeThirdAsZ())
      return;
    const TableSample sample = sampleTable(layout_.body, layout_.delimiter, layout_.columns_in_row);
    const std::string doubt = UnnamedColumns(sample, picks_.notes).settle(layout_.columns);
    if (!doubt.empty())
      fail("the columns of x, y and z are not certain: " + doubt);
    if (layout_.columns_in_row > 3)
      picks_.notes.push_back("columns " + numbersOf({layout_.columns.begin(), layout_.columns.end()}) + " of " +
                             std::to_string(layout_.columns_in_row) + " taken as x, y, z");
    else
      noteWholeNumbers(sample);
  }

private:
  /// A header that names one column less than rows have, as R writes it: the first is the row's number.
  void leaveOutRowNumbers() {
    if (layout_.shift > 0 || layout_.names.size() + 1 != layout_.columns_in_row)
      return;
    const TableSample sample = sampleTable(layout_.body, layout_.delimiter, layout_.columns_in_row);
    if (!sample.columns[0].counter)
      return;
    layout_.shift = 1;
    for (int& column : layout_.columns)
      ++column;
    picks_.notes.emplace_back("column 1, which the header does not name, taken for a row number and left out");
  }

  /// Of three columns of which the header calls two x and y, the third is z whatever its name.
  bool takeThirdAsZ() {
    const auto place = findCoordinateColumns(layout_.names);
    if (layout_.names.size() != 3 || layout_.columns_in_row != 3 || place[0] < 0 || place[1] < 0)
      return false;
    layout_.columns = {place[0], place[1], 3 - place[0] - place[1]};
    layout_.names_used = true;
    picks_.notes.push_back("column " + std::to_string(layout_.columns[2] + 1) + ", '" + nameOf(layout_, static_cast<std::size_t>(layout_.columns[2])) +
                           "', taken as z");
    return true;
  }

  [[noreturn]] void fail(const std::string& message) const {
    throw ParseError(file_.path, layout_.first_line,
                     message + "; name them: --columns X,Y,Z, each by its number from 1" +
                         (layout_.names.empty() ? "" : " or its name (" + listOf(layout_.names) + ")"));
  }

  void takeAsked() {
    const std::size_t shift = layout_.shift;
    layout_.columns.clear();
    std::vector<std::string> taken;
    for (const std::string& wanted : file_.options.columns) {
      int column = findColumn(layout_.names, wanted, 0);
      column = column >= 0 ? column + static_cast<int>(shift) : findColumn({}, wanted, layout_.columns_in_row);
      if (column < 0)
        throw ParseError(file_.path, layout_.first_line,
                         "has no column '" + wanted + "': a row has " + std::to_string(layout_.columns_in_row) + " columns" +
                             (layout_.names.empty() ? " and the header names none" : ", named " + listOf(layout_.names)));
      layout_.columns.push_back(column);
      taken.push_back(std::to_string(column + 1));
    }
    layout_.names_used = !nameOf(layout_, static_cast<std::size_t>(layout_.columns[2])).empty();
    picks_.notes.push_back("columns " + listOf(taken) + " of " + std::to_string(layout_.columns_in_row) + " taken as x, y, z, as asked");
  }

  void refuseOtherNames() const {
    const auto has = [&](ColumnRole role) { return findColumn(layout_.names, role) >= 0; };
    const auto place = findCoordinateColumns(layout_.names);
    if (place[0] >= 0 && place[1] >= 0)
      return;
    if (has(ColumnRole::Longitude) && has(ColumnRole::Latitude))
      throw ParseError(file_.path, layout_.first_line - 1,
                       "places are in longitude and latitude; project them to x and y in metres first (degrees are no lengths)");
    if (has(ColumnRole::Inline) && has(ColumnRole::Crossline))
      fail("the header names inline and crossline, but no x and y, which are needed; export x and y too");
  }

  void noteWholeNumbers(const TableSample& sample) {
    if (sample.rows < 50 || sample.columns.size() < 2 || !sample.columns[0].integral || !sample.columns[1].integral)
      return;
    const auto step = [&](std::size_t c) {
      std::vector<double> values = sample.columns[c].values;
      std::sort(values.begin(), values.end());
      double smallest = sample.columns[c].span();
      for (std::size_t i = 1; i < values.size(); ++i)
        if (values[i] > values[i - 1])
          smallest = std::min(smallest, values[i] - values[i - 1]);
      return smallest;
    };
    if (step(0) <= 2.0 && step(1) <= 4.0 && sample.columns[0].low > 0.0 && sample.columns[1].low > 0.0)
      picks_.warnings.push_back("the first two columns of " + file_.path +
                                " are whole numbers in small steps: if they are inline and crossline, export x and y, or distances are wrong");
  }

  TextLayout& layout_;
  const PickFile& file_;
  PickSet& picks_;
};

/// What the name of the column of z says of it.
void takeNameOfZ(const TextLayout& layout, PickSet& picks) {
  const std::string x = nameOf(layout, static_cast<std::size_t>(layout.columns[0]));
  const std::string z = nameOf(layout, static_cast<std::size_t>(layout.columns[2]));
  if (!layout.names_used || z.empty())
    return;
  picks.z_unit = unitOfName(z).empty() ? picks.z_unit : unitOfName(z);
  picks.xy_unit = unitOfName(x).empty() ? picks.xy_unit : unitOfName(x);
  const int sense = senseOfName(z);
  if (sense == 0)
    return;
  picks.z_positive = sense > 0 ? ZPositive::Up : ZPositive::Down;
  picks.z_reason = "the header calls z '" + z + "'";
}

} // namespace

NamedColumns pointColumns(const std::vector<std::string>& names) {
  const auto found = findCoordinateColumns(names);
  const bool z_missing = found[0] >= 0 && found[1] >= 0 && found[2] < 0 && names.size() > 3;
  if (const std::string twice = nameGivenTwice(names); !twice.empty() && found[0] >= 0 && found[1] >= 0)
    return {{found.begin(), found.end()}, "the header names two columns '" + twice + "'; name x, y and z by their numbers: --columns 1,2,3"};
  if (const std::string other = otherNameForZ(names); !other.empty() && found[0] >= 0 && found[1] >= 0)
    return {{found.begin(), found.end()}, "two columns may be z, '" + names[static_cast<std::size_t>(found[2])] + "' and '" + other +
                                              "'; name one: --columns X,Y,Z, each by its name or its number from 1"};
  return {{found.begin(), found.end()}, z_missing ? "the header names columns x and y but none for z; name them: --columns X,Y,Z" : ""};
}

void settleColumns(TextLayout& layout, const PickFile& file, PickSet& picks) {
  ColumnChoice(layout, file, picks).settle();
  takeNameOfZ(layout, picks);
}

HorizonColumn findHorizons(const TextLayout& layout, const TableSample& sample) {
  HorizonColumn found;
  const int named = findColumn(layout.names, ColumnRole::Horizon);
  const int label = findColumn(layout.names, ColumnRole::Fault); // "name", "object" and the like
  for (std::size_t c = 0; c < sample.columns.size() && found.column < 0; ++c) {
    const bool is_named = named >= 0 && c == static_cast<std::size_t>(named) + layout.shift;
    const bool is_label = named < 0 && label >= 0 && c == static_cast<std::size_t>(label) + layout.shift;
    const bool unnamed_text = (is_label || nameOf(layout, c).empty()) && sample.columns[c].numbers == 0;
    const bool taken = std::find(layout.columns.begin(), layout.columns.end(), static_cast<int>(c)) != layout.columns.end();
    if ((is_named || unnamed_text) && !taken)
      found.column = static_cast<int>(c);
  }
  if (found.column < 0)
    return found;
  std::map<std::string, std::size_t, std::less<>> rows;
  LineReader reader(layout.body);
  std::string_view line;
  std::vector<std::string_view> fields;
  std::size_t count = 0;
  while (reader.next(line) && rows.size() <= most_horizons) {
    if (isPassedOver(line))
      continue;
    splitFields(line, layout.delimiter, fields);
    if (fields.size() <= static_cast<std::size_t>(found.column))
      continue;
    ++count;
    const std::string_view name = fields[static_cast<std::size_t>(found.column)];
    auto entry = rows.find(name);
    if (entry == rows.end()) {
      entry = rows.emplace(std::string(name), 0).first;
      found.names.emplace_back(name);
    }
    ++entry->second;
  }
  constexpr std::size_t rows_of_a_horizon = 3;
  const bool is_named = named >= 0 && found.column == named + static_cast<int>(layout.shift);
  if (rows.size() > most_horizons || (!is_named && rows.size() * rows_of_a_horizon > count)) // labels of points, not of horizons
    return {};
  return found;
}

std::string onlyHorizon(std::string_view body, const TextLayout& layout, int column, const std::string& name) {
  std::string text;
  LineReader reader(body);
  std::string_view line;
  std::vector<std::string_view> fields;
  while (reader.next(line)) {
    if (!isPassedOver(line)) {
      splitFields(line, layout.delimiter, fields);
      const auto at = static_cast<std::size_t>(column);
      if (fields.size() <= at || fields[at] == name) // rows that cannot be told are judged with the others
        text += line;
    }
    text += '\n';
  }
  return text;
}

std::string severalHorizons(const std::vector<std::string>& names) {
  std::vector<std::string> listed(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(std::min(names.size(), most_listed)));
  if (names.size() > most_listed)
    listed.push_back("and " + std::to_string(names.size() - most_listed) + " more");
  return "holds " + std::to_string(names.size()) + " horizons: " + listOf(listed) + "; name one: --horizon FILE:NAME";
}

} // namespace graben
