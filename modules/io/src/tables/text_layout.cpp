#include "tables/text_layout.h"

#include "content/line_reader.h"
#include "content/numbers.h"
#include "tables/column_names.h"

#include "graben/core/errors.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace graben {
namespace {

constexpr std::size_t most_header_lines = 1000;
constexpr std::size_t most_trailing_lines = 10;

/// How the fields of a row may be parted, likeliest first. A lone tab parts two fields, so that a
/// field may be empty; several tabs are padding.
std::string delimitersOf(std::string_view line) {
  std::string row;
  bool quoted = false;
  for (const char c : line) {
    quoted ^= c == '"';
    row += quoted ? '"' : c;
  }
  for (const char* c : {";", ","})
    if (row.find(c) != std::string::npos)
      return c;
  const bool lone_tabs = row.find('\t') != std::string::npos &&
                         row.find("\t\t") == std::string::npos && row.front() != '\t';
  return lone_tabs ? "\t " : " ";
}

bool isNumber(std::string_view field) {
  double value = 0.0;
  return !field.empty() && parseField(field, value);
}

bool isDigits(std::string_view field) {
  return !field.empty() && field.find_first_not_of("0123456789") == std::string_view::npos;
}

/// `461000,50,5931000,25,-2000,75`: the decimals are fields of their own.
bool hasCommasForBoth(const std::vector<std::string_view>& fields) {
  if (fields.size() < 6 || fields.size() % 2 != 0)
    return false;
  for (std::size_t i = 0; i < fields.size(); i += 2) {
    const std::string_view whole = fields[i].substr(fields[i].substr(0, 1) == "-" ? 1 : 0);
    if (!isDigits(whole) || !isDigits(fields[i + 1]) || fields[i + 1].size() < 2 || fields[i + 1].size() > 3)
      return false;
  }
  return true;
}

void refuseCommasForBoth(const TextLayout& layout, const std::string& path) {
  constexpr std::size_t rows_looked_at = 20;
  LineReader reader(layout.body);
  std::string_view line;
  std::vector<std::string_view> fields;
  std::vector<std::size_t> widths;
  std::size_t rows = 0;
  while (layout.delimiter == ',' && rows < rows_looked_at && reader.next(line)) {
    if (isPassedOver(line))
      continue;
    splitFields(line, ',', fields);
    std::vector<std::size_t> found;
    for (std::size_t i = 1; i < fields.size(); i += 2)
      found.push_back(fields[i].size());
    if (!hasCommasForBoth(fields) || (rows > 0 && found != widths))
      return;
    widths = found;
    ++rows;
  }
  if (rows > 0)
    throw ParseError(path, layout.first_line, "commas stand between the columns and before the decimals; write it with semicolons or points");
}

/// `1,5` in two fields or more that are not parted by commas; in one where semicolons part them.
bool isRowWithDecimalCommas(std::string_view row) {
  const bool semicolons = row.find(';') != std::string_view::npos;
  std::vector<std::string_view> words;
  splitFields(row, semicolons ? ';' : ' ', words);
  if (!semicolons && row.find("\",\"") != std::string_view::npos)
    splitFields(row, ',', words);
  const auto is_decimal = [](std::string_view word) {
    const std::size_t comma = word.find(',');
    return comma != std::string_view::npos && word.find('.') == std::string_view::npos &&
           isNumber(word.substr(0, comma)) && isNumber(word.substr(comma + 1));
  };
  return std::count_if(words.begin(), words.end(), is_decimal) >= (semicolons ? 1 : 2);
}

/// `5.931.000,50` or `461,000.25`: digits in groups of three, and more groups than two or decimals behind them.
bool hasThousands(std::string_view word) {
  std::size_t at = 0;
  const auto digits = [&] {
    const std::size_t begin = at;
    while (at < word.size() && word[at] >= '0' && word[at] <= '9')
      ++at;
    return at - begin;
  };
  at = word.substr(0, 1) == "-" ? 1 : 0;
  const std::size_t first = digits();
  if (first < 1 || first > 3 || at == word.size() || (word[at] != '.' && word[at] != ','))
    return false;
  const char separator = word[at];
  std::size_t groups = 1;
  for (; at < word.size() && word[at] == separator; ++groups) {
    ++at;
    if (digits() != 3)
      return false;
  }
  const bool decimals = groups > 1 && at + 1 < word.size() && (word[at] == '.' || word[at] == ',');
  at += decimals ? 1 : 0;
  return (decimals && digits() > 0 && at == word.size()) || (groups > 2 && at == word.size());
}

void refuseThousands(std::string_view line, const std::string& path, std::size_t number) {
  std::string words_of(line);
  std::replace_if(
      words_of.begin(), words_of.end(), [](char c) { return c == ';' || c == '"' || c == '\t'; }, ' ');
  std::vector<std::string_view> words;
  splitWords(words_of, words);
  const auto found = std::find_if(words.begin(), words.end(), hasThousands);
  if (found != words.end())
    throw ParseError(path, number, "numbers with thousands separators (" + std::string(found->substr(0, 40)) + "); write them without");
}

/// Finds where the wanted numbers stand in a row parted by layout.delimiter.
/// \returns false if the row is none of numbers
bool findColumns(std::string_view row, const std::vector<int>& named, TextLayout& layout) {
  std::vector<std::string_view> fields;
  splitFields(row, layout.delimiter, fields);
  layout.columns_in_row = fields.size();
  // Exports of several horizons, and R, start each row with a quoted name that the header does not list.
  const bool quoted_name = trim(row).substr(0, 1) == "\"" && (!isNumber(fields.front()) || std::count(row.begin(), row.end(), '"') == 2);
  const bool one_more = layout.names.size() + 1 == fields.size();
  layout.shift = !layout.names.empty() && layout.names.size() != fields.size() && (quoted_name || (one_more && !isNumber(fields.front()))) ? 1 : 0;
  layout.names_used = *std::min_element(named.begin(), named.end()) >= 0;
  const bool ruled = std::none_of(fields.begin(), fields.end(), [](std::string_view f) { return f.find_first_not_of("-*?") != std::string_view::npos; });
  if (ruled) // `--- --- ---` below the names
    return false;
  if (!layout.names_used) {
    layout.columns.clear();
    for (std::size_t i = 0; i < fields.size() && layout.columns.size() < named.size(); ++i)
      if (isNumber(fields[i]))
        layout.columns.push_back(static_cast<int>(i));
    return layout.columns.size() == named.size();
  }
  layout.columns = named;
  std::size_t numbers = 0;
  for (int& column : layout.columns) {
    column += static_cast<int>(layout.shift);
    const auto at = static_cast<std::size_t>(column);
    const bool no_data = at < fields.size() && fields[at].empty() && layout.delimiter != ' ';
    if (at >= fields.size() || !(no_data || isNumber(fields[at])))
      return false;
    numbers += no_data ? 0 : 1;
  }
  return numbers + 1 >= named.size();
}

bool layoutOfRow(std::string_view row, const std::vector<int>& named, TextLayout& layout) {
  const std::string delimiters = delimitersOf(row);
  return std::any_of(delimiters.begin(), delimiters.end(), [&](char delimiter) {
    layout.delimiter = delimiter;
    return findColumns(row, named, layout);
  });
}

/// A row in which text stands before the numbers may be prose; it is none if the next row is built alike.
bool isRowOfTable(const TextLayout& layout, LineReader after) {
  const bool numbers_first = layout.names_used || layout.columns.back() + 1 == static_cast<int>(layout.columns.size());
  std::string_view next;
  while (!numbers_first && after.next(next)) {
    if (isPassedOver(next))
      continue;
    TextLayout other = layout;
    return findColumns(next, std::vector<int>(layout.columns.size(), -1), other) && other.columns == layout.columns;
  }
  return true;
}

std::string listOf(const std::vector<std::string>& items, const char* last = ", ") {
  std::string list;
  for (std::size_t i = 0; i < items.size(); ++i)
    list += (i == 0 ? "" : (i + 1 == items.size() ? last : ", ")) + items[i];
  return list;
}

/// A line before the first row may be anything but a row of numbers that lacks one.
void refuseShortRow(std::string_view line, const std::string& path, std::size_t number,
                    const TableKind& kind) {
  refuseThousands(line, path, number);
  if (isRowWithDecimalCommas(line))
    throw ParseError(path, number, "numbers with decimal commas among others; write them with points");
  std::string blanks(line);
  std::replace_if(
      blanks.begin(), blanks.end(), [](char c) { return c == ',' || c == ';'; }, ' ');
  std::vector<std::string_view> words;
  splitWords(blanks, words);
  if (words.size() >= 2 && isNumber(words[0]) && isNumber(words[1]))
    throw ParseError(path, number,
                     "a row of numbers without " + listOf(kind.wanted, " and ") + ": '" +
                         std::string(line.substr(0, 60)) + "'");
}

} // namespace

TextLayout findLayout(std::string_view text, const std::string& path, const TableKind& kind, bool by_name) {
  TextLayout layout;
  HeaderNames header;
  LineReader reader(text);
  std::string_view line;
  layout.body = reader.rest();
  for (std::size_t lines = 0; lines < most_header_lines && reader.next(line); ++lines) {
    if (!isPassedOver(line) && !header.insideBlock()) {
      layout.names = header.names();
      NamedColumns named = kind.by_name(layout.names);
      if (!by_name)
        named = {std::vector<int>(kind.wanted.size(), -1), {}};
      layout.first_line = reader.number();
      if (layoutOfRow(line, named.columns, layout) && isRowOfTable(layout, reader)) {
        if (!named.missing.empty())
          throw ParseError(path, reader.number() - 1, named.missing);
        if (by_name)
          refuseCommasForBoth(layout, path);
        layout.nulls = header.nulls();
        layout.xy_unit = header.xyUnit();
        layout.z_unit = header.zUnit();
        return layout;
      }
      refuseShortRow(line, path, reader.number(), kind);
    }
    header.add(line);
    layout.body = reader.rest();
  }
  throw ParseError(path, 0, "is no " + kind.noun + ": no row of numbers " + listOf(kind.wanted, " and ") + " found");
}

bool hasDecimalCommas(std::string_view text) {
  constexpr std::size_t rows_looked_at = 50;
  LineReader reader(text.substr(0, 1 << 16));
  std::string_view line;
  std::size_t rows = 0;
  bool last = false;
  while (rows < rows_looked_at && reader.next(line)) {
    if (isPassedOver(line) || line.find_first_of("0123456789") == std::string_view::npos)
      continue;
    ++rows;
    if (line.find('.') != std::string_view::npos)
      last = false;
    else if (isRowWithDecimalCommas(line))
      last = true;
  }
  return last;
}

std::string withDecimalPoints(std::string_view text) {
  std::string points(text);
  const auto digit = [&](std::size_t i) { return points[i] >= '0' && points[i] <= '9'; };
  for (std::size_t i = 1; i + 1 < points.size(); ++i)
    if (points[i] == ',' && digit(i - 1) && digit(i + 1))
      points[i] = '.';
  return points;
}

bool isLastRowCut(std::string_view body, char delimiter, int column) {
  constexpr std::size_t rows_looked_at = 10;
  if (body.empty() || body.back() == '\n')
    return false;
  // Whether a number has an exponent, and how many digits follow its point.
  const auto form = [](std::string_view field) {
    const std::size_t point = field.find('.');
    const std::size_t end = std::min(field.find_first_not_of("0123456789", point == std::string_view::npos ? 0 : point + 1), field.size());
    return std::pair(field.find_first_of("eEdD") != std::string_view::npos, point == std::string_view::npos ? std::size_t{0} : end - point - 1);
  };
  std::vector<std::string_view> fields;
  std::vector<std::pair<bool, std::size_t>> forms;
  while (!body.empty() && forms.size() <= rows_looked_at) {
    const std::size_t newline = body.find_last_of('\n');
    const std::string_view line = trim(newline == std::string_view::npos ? body : body.substr(newline + 1));
    body = newline == std::string_view::npos ? std::string_view{} : body.substr(0, newline);
    if (isPassedOver(line))
      continue;
    splitFields(line, delimiter, fields);
    double value = 0.0;
    if (fields.size() != static_cast<std::size_t>(column) + 1 || !parseField(fields.back(), value) || !std::isfinite(value))
      return false;
    forms.push_back(form(fields.back()));
  }
  const bool others_agree = std::all_of(forms.begin() + 1, forms.end(), [&](const auto& f) { return f == forms[1]; });
  return forms.size() > 5 && others_agree && (forms[0].first != forms[1].first || forms[0].second < forms[1].second);
}

std::string cutRowWarning(const std::string& path) {
  return path + ": the last row has no line end and fewer decimals than the others; it is left out, the file may be cut short";
}

void noteColumns(const TextLayout& layout, const TableKind& kind, std::vector<std::string>& notes) {
  const auto& used = layout.columns;
  if (!layout.names_used) {
    std::vector<std::string> numbers;
    for (const int column : used)
      numbers.push_back(std::to_string(column + 1));
    if (layout.columns_in_row > used.size() || used.size() > 3)
      notes.push_back("columns " + listOf(numbers) + " of " + std::to_string(layout.columns_in_row) + " taken as " +
                      listOf(kind.wanted));
    return;
  }
  const int shift = static_cast<int>(layout.shift);
  std::vector<std::string> ignored;
  for (std::size_t i = 0; i < layout.names.size(); ++i)
    if (std::find(used.begin(), used.end(), static_cast<int>(i) + shift) == used.end())
      ignored.push_back(layout.names[i].empty() ? "?" : layout.names[i]);
  if (!ignored.empty())
    notes.push_back("columns ignored: " + listOf(ignored));
}

void judgeBadRows(const std::vector<std::size_t>& bad_lines, std::size_t last_line, const TableKind& kind, PickSet& picks) {
  if (bad_lines.empty())
    return;
  const std::size_t first = bad_lines.front();
  const std::string count = std::to_string(bad_lines.size());
  if (first < last_line || bad_lines.size() > most_trailing_lines)
    throw ParseError(picks.source, first,
                     "this row is no " + kind.row + " with " + listOf(kind.wanted, " and ") + " (" + count + " such rows in the file)");
  picks.rejected_rows = bad_lines.size();
  picks.notes.push_back(count + " rows after the last " + kind.row + " are no " + kind.row + "s, first in line " +
                        std::to_string(first));
}

} // namespace graben
