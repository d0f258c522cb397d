#include "pick_formats.h"

#include "column_names.h"
#include "text_layout.h"

namespace graben {
namespace {

NamedColumns pointColumns(const std::vector<std::string>& names) {
  const auto found = findCoordinateColumns(names);
  const bool z_missing = !names.empty() && found[2] < 0 && names.size() > 3;
  return {{found.begin(), found.end()}, z_missing ? "the header names columns x and y but none for z" : ""};
}

const TableKind& pointTable() {
  static const TableKind kind{"point cloud", "point", {"x", "y", "z"}, pointColumns};
  return kind;
}

} // namespace

PickSet readTextPicks(std::string_view text, const PickFile& file) {
  const TextLayout layout = findLayout(text, file.path, pointTable());
  Table<3> table = readTable<3>(tableSource(layout.body, layout.first_line, file), tableLayoutOf<3>(layout));
  PickSet picks;
  picks.source = file.path;
  noteColumns(layout, pointTable(), picks.notes);
  judgeBadRows(table.bad_lines, table.last_line, pointTable(), picks);
  picks.points = std::move(table.rows);
  return picks;
}

} // namespace graben
