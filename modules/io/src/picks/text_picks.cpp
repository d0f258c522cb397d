#include "picks/pick_columns.h"
#include "picks/pick_formats.h"
#include "tables/column_names.h"
#include "tables/plain_table.h"
#include "tables/text_layout.h"

#include "graben/core/errors.h"

#include <algorithm>
#include <limits>

namespace graben {
namespace {

std::string layoutText(const TextLayout& layout) {
  const std::string separator = layout.delimiter == ' ' ? "blanks" : (layout.delimiter == '\t' ? "tabs" : std::string("'") + layout.delimiter + "'");
  std::string text = std::to_string(layout.columns_in_row) + " columns parted by " + separator + ", x y z in columns ";
  for (std::size_t k = 0; k < 3; ++k)
    text += (k == 0 ? "" : ", ") + std::to_string(layout.columns[k] + 1);
  text += layout.names_used ? " (named in the header)" : " (the header names none)";
  return text + ", first row in line " + std::to_string(layout.first_line);
}

/// Leaves the rows of one horizon in the layout's body.
void chooseHorizon(TextLayout& layout, const PickFile& file, PickSet& picks, std::string& storage) {
  const TableSample sample = sampleTable(layout.body, layout.delimiter, layout.columns_in_row);
  const HorizonColumn horizons = findHorizons(layout, sample);
  const std::string& wanted = file.options.horizon;
  if (wanted.empty()) {
    if (horizons.names.size() > 1)
      throw SeveralHorizonsError(file.path, severalHorizons(horizons.names) + " (column " + std::to_string(horizons.column + 1) + ")", horizons.names);
    picks.horizon = horizons.names.empty() ? "" : horizons.names.front();
    return;
  }
  requireHorizon(horizons.names, file);
  picks.horizon = wanted;
  if (horizons.names.size() > 1) {
    storage = onlyHorizon(layout.body, layout, horizons.column, wanted);
    layout.body = storage;
  }
}

/// A first row that counts those after it, as `1200 3 1`, far from all of them.
void dropCountOfRows(const TextLayout& layout, std::vector<Vector3>& rows, PickSet& picks) {
  const std::size_t count = rows.size() - 1;
  if (layout.names_used || rows.size() < 5 || rows[0].x() != static_cast<double>(count))
    return;
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    low = std::min(low, rows[i].x());
    high = std::max(high, rows[i].x());
  }
  const double span = high - low;
  if (!(rows[0].x() < low - 2.0 * span || rows[0].x() > high + 2.0 * span))
    return;
  rows.erase(rows.begin());
  picks.notes.push_back("line " + std::to_string(layout.first_line) + " taken for the number of the rows and left out");
}

void dropCutRow(const TextLayout& layout, std::size_t bad_rows, std::vector<Vector3>& rows, PickSet& picks) {
  if (rows.empty() || bad_rows > 0 || !isLastRowCut(layout.body, layout.delimiter, layout.columns[2]))
    return;
  rows.pop_back();
  ++picks.rejected_rows;
  picks.warnings.push_back(cutRowWarning(picks.source));
}

} // namespace

const TableKind& pointTableKind() {
  static const TableKind kind{"point cloud", "point", {"x", "y", "z"}, pointColumns};
  return kind;
}

void requireHorizon(const std::vector<std::string>& names, const PickFile& file) {
  if (names.empty())
    throw ParseError(file.path, 0, "names no horizon, so '" + file.options.horizon + "' cannot be told from others");
  if (std::find(names.begin(), names.end(), file.options.horizon) == names.end())
    throw ParseError(file.path, 0, "holds no horizon '" + file.options.horizon + "'; it " + severalHorizons(names));
}

PickSet readTextPicks(std::string_view text, const PickFile& file) {
  PickSet picks;
  picks.source = file.path;
  picks.format = "text table";
  std::string plain;
  text = plainTable(text, file.path, plain, picks.notes);
  TextLayout layout = findLayout(text, file.path, pointTableKind(), file.options.columns.empty());
  picks.xy_unit = layout.xy_unit;
  picks.z_unit = layout.z_unit;
  settleColumns(layout, file, picks);
  std::string storage;
  chooseHorizon(layout, file, picks, storage);
  picks.layout = layoutText(layout);
  picks.header_nulls = layout.nulls;
  Table<3> table = readTable<3>(tableSource(layout.body, layout.first_line, file), tableLayoutOf<3>(layout));
  judgeBadRows(table.bad_lines, table.last_line, pointTableKind(), picks);
  dropCutRow(layout, table.bad_lines.size(), table.rows, picks);
  dropCountOfRows(layout, table.rows, picks);
  picks.points = std::move(table.rows);
  return picks;
}

} // namespace graben
