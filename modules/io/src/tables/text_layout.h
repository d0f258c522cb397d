#pragma once

#include "tables/table_reader.h"
#include "tables/table_sample.h"

#include "graben/io/pick_set.h"

#include <string>
#include <string_view>
#include <vector>

namespace graben {

/// Where the wanted columns stand by name.
struct NamedColumns {
  std::vector<int> columns; ///< one per wanted number, -1 where no name fits
  std::string missing;      ///< what the header lacks although it names others; empty: nothing
};

/// What a text table is to hold.
struct TableKind {
  std::string noun;                ///< of the file, "point cloud"
  std::string row;                 ///< of a row, "point"
  std::vector<std::string> wanted; ///< the numbers, in the order of the default columns
  NamedColumns (*by_name)(const std::vector<std::string>& names);
};

/// What stands before the first row of numbers, and how the rows are built.
struct TextLayout {
  char delimiter = ' ';
  std::vector<int> columns; ///< of the wanted numbers
  std::vector<std::string> names;
  std::size_t columns_in_row = 0;
  std::size_t shift = 0;      ///< columns before the first that has a name: some exports begin rows with a name that the header does not list
  std::size_t first_line = 1; ///< number of the first row's line
  std::string_view body;      ///< from the first row on
  bool names_used = false;
  std::vector<double> nulls;   ///< what the header calls null
  std::string xy_unit, z_unit; ///< as the header says
};

/// Goes over the header of a text table. Without names the wanted numbers are the first ones of a row.
/// \param[in] by_name whether names in the header count
/// \throw ParseError if no row holds the wanted numbers, or the header names others but not all of them
TextLayout findLayout(std::string_view text, const std::string& path, const TableKind& kind, bool by_name = true);

/// What a table of points has.
const TableKind& pointTableKind();

/// True if the rows of a table hold numbers as `1,5` that can be read in no other way: parted by semicolons, blanks or tabs, without points.
bool hasDecimalCommas(std::string_view text);

/// The text with points for commas between digits.
std::string withDecimalPoints(std::string_view text);

/// The columns the table has and nobody wants, for the user; and those taken unnamed.
void noteColumns(const TextLayout& layout, const TableKind& kind, std::vector<std::string>& notes);

/// Unreadable rows among the others are an error; a few after the last good one are told.
void judgeBadRows(const std::vector<std::size_t>& bad_lines, std::size_t last_line, const TableKind& kind, PickSet& picks);

/// True if the last row of a table has no line end and its last number, in \a column, fewer decimals than all others: it is cut short.
bool isLastRowCut(std::string_view body, char delimiter, int column);

/// The warning about such a row.
std::string cutRowWarning(const std::string& path);

template <int K>
TableLayout<K> tableLayoutOf(const TextLayout& layout) {
  TableLayout<K> table;
  table.delimiter = layout.delimiter;
  std::copy_n(layout.columns.begin(), K, table.columns.begin());
  return table;
}

} // namespace graben
