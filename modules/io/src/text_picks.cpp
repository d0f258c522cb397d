#include "pick_formats.h"

#include "column_names.h"
#include "line_reader.h"
#include "numbers.h"
#include "table_reader.h"

#include "graben/core/errors.h"

#include <algorithm>
#include <filesystem>

namespace graben {
namespace {

constexpr std::size_t most_header_lines = 1000;
constexpr std::size_t most_trailing_lines = 10;

/// What stands before the first row of numbers, and how the rows are built.
struct TextLayout {
  TableLayout<3> table;
  std::vector<std::string> names;
  std::size_t columns = 0;    ///< in the first row
  std::size_t first_line = 1; ///< number of the first row's line
  std::string_view body;      ///< from the first row on
  bool names_used = false;
};

/// How the fields of a row may be parted, likeliest first. A lone tab parts two fields, so that a
/// field may be empty; several tabs are padding.
std::string delimitersOf(std::string_view row) {
  for (const char* c : {";", ","})
    if (row.find(c) != std::string_view::npos)
      return c;
  const bool lone_tabs = row.find('\t') != std::string_view::npos &&
                         row.find("\t\t") == std::string_view::npos && row.front() != '\t';
  return lone_tabs ? "\t " : " ";
}

bool isNumber(std::string_view field) {
  double value = 0.0;
  return !field.empty() && parseField(field, value);
}

/// `1,5` in two fields or more that are not parted by commas.
bool hasDecimalCommas(std::string_view row) {
  std::vector<std::string_view> words;
  splitFields(row, row.find(';') != std::string_view::npos ? ';' : ' ', words);
  const auto is_decimal = [](std::string_view word) {
    const std::size_t comma = word.find(',');
    return comma != std::string_view::npos && word.find('.') == std::string_view::npos &&
           isNumber(word.substr(0, comma)) && isNumber(word.substr(comma + 1));
  };
  return std::count_if(words.begin(), words.end(), is_decimal) >= 2;
}

/// Finds where x, y and z stand in a row parted by layout.table.delimiter.
/// \returns false if the row is none of numbers
bool findColumns(std::string_view row, const std::array<int, 3>& named, TextLayout& layout) {
  std::vector<std::string_view> fields;
  splitFields(row, layout.table.delimiter, fields);
  layout.columns = fields.size();
  layout.names_used = *std::min_element(named.begin(), named.end()) >= 0;
  // Exports of several horizons start each row with a quoted name that the header does not list.
  const bool quoted_name = trim(row).front() == '"' && !isNumber(fields.front());
  const bool listed = layout.names_used && layout.names.size() == fields.size();
  const int shift = quoted_name && !listed ? 1 : 0;
  layout.table.columns = layout.names_used ? named : std::array<int, 3>{0, 1, 2};
  for (int& column : layout.table.columns) {
    column += shift;
    const auto at = static_cast<std::size_t>(column);
    if (at >= fields.size() || !isNumber(fields[at]))
      return false;
  }
  return true;
}

bool layoutOfRow(std::string_view row, const std::array<int, 3>& named, TextLayout& layout) {
  const std::string delimiters = delimitersOf(row);
  return std::any_of(delimiters.begin(), delimiters.end(), [&](char delimiter) {
    layout.table.delimiter = delimiter;
    return findColumns(row, named, layout);
  });
}

/// A line before the first row may be anything but a row of numbers that lacks one.
void refuseShortRow(std::string_view line, const std::string& path, std::size_t number) {
  if (hasDecimalCommas(line))
    throw ParseError(path, number, "numbers with decimal commas; write them with points");
  std::string blanks(line);
  std::replace_if(
      blanks.begin(), blanks.end(), [](char c) { return c == ',' || c == ';'; }, ' ');
  std::vector<std::string_view> words;
  splitWords(blanks, words);
  if (words.size() >= 2 && isNumber(words[0]) && isNumber(words[1]))
    throw ParseError(path, number,
                     "a row of numbers without x, y and z: '" + std::string(line.substr(0, 60)) +
                         "'");
}

TextLayout findLayout(std::string_view text, const std::string& path) {
  TextLayout layout;
  std::vector<std::string_view> header;
  LineReader reader(text);
  std::string_view line;
  layout.body = reader.rest();
  while (header.size() < most_header_lines && reader.next(line)) {
    if (!isPassedOver(line)) {
      layout.names = columnNames(header);
      const auto named = findCoordinateColumns(layout.names);
      layout.first_line = reader.number();
      if (layoutOfRow(line, named, layout)) {
        const bool z_missing = !layout.names.empty() && named[2] < 0 && layout.names.size() > 3;
        if (z_missing)
          throw ParseError(path, reader.number() - 1,
                           "the header names columns x and y but none for z");
        return layout;
      }
      refuseShortRow(line, path, reader.number());
    }
    header.push_back(line);
    layout.body = reader.rest();
  }
  throw ParseError(path, 0, "is no point cloud: no row of numbers x y z found");
}

std::string listOf(const std::vector<std::string>& items) {
  std::string list;
  for (const std::string& item : items)
    list += (list.empty() ? "" : ", ") + item;
  return list;
}

void noteColumns(const TextLayout& layout, PickSet& picks) {
  const auto& used = layout.table.columns;
  if (!layout.names_used) {
    if (layout.columns > 3)
      picks.notes.push_back("columns 1, 2, 3 of " + std::to_string(layout.columns) +
                            " taken as x, y, z");
    return;
  }
  const int shift = layout.names.size() + 1 == layout.columns && used[0] > 0 ? 1 : 0;
  std::vector<std::string> ignored;
  for (std::size_t i = 0; i < layout.names.size(); ++i)
    if (std::find(used.begin(), used.end(), static_cast<int>(i) + shift) == used.end())
      ignored.push_back(layout.names[i].empty() ? "?" : layout.names[i]);
  if (!ignored.empty())
    picks.notes.push_back("columns ignored: " + listOf(ignored));
}

/// Unreadable rows among the points are an error; a few after the last point are told.
void judgeBadRows(const Table<3>& table, const std::string& path, PickSet& picks) {
  if (table.bad_lines.empty())
    return;
  const std::size_t first = table.bad_lines.front();
  if (first < table.last_line || table.bad_lines.size() > most_trailing_lines)
    throw ParseError(path, first,
                     "this row is no point x y z (" + std::to_string(table.bad_lines.size()) +
                         " such rows in the file)");
  picks.rejected_rows = table.bad_lines.size();
  picks.notes.push_back(std::to_string(table.bad_lines.size()) +
                        " rows after the last point are no points, first in line " +
                        std::to_string(first));
}

} // namespace

PickSet readTextPicks(std::string_view bytes, const std::string& path, const ReadOptions& options) {
  const TextLayout layout = findLayout(bytes, path);
  TableSource source;
  source.text = layout.body;
  source.first_line = layout.first_line;
  source.threads = options.threads;
  source.progress = options.progress;
  source.stage = "reading " + std::filesystem::path(path).filename().string();
  Table<3> table = readTable<3>(source, layout.table);
  PickSet picks;
  noteColumns(layout, picks);
  judgeBadRows(table, path, picks);
  picks.points = std::move(table.rows);
  return picks;
}

} // namespace graben
