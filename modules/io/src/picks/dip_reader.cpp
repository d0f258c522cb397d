#include "graben/io/dip_reader.h"

#include "content/file_content.h"
#include "content/no_data.h"
#include "picks/file_format.h"
#include "picks/pick_formats.h"
#include "tables/column_names.h"
#include "tables/text_layout.h"

#include "graben/core/errors.h"

#include <cmath>
#include <limits>

namespace graben {
namespace {

using Row = Eigen::Matrix<double, 5, 1>;

/// x y z, dip, and azimuth or strike.
NamedColumns dipColumns(const std::vector<std::string>& names) {
  const auto place = findCoordinateColumns(names);
  const DipColumns angles = findDipColumns(names);
  const int direction = angles.azimuth >= 0 ? angles.azimuth : angles.strike;
  NamedColumns named{{place[0], place[1], place[2], angles.dip, direction}, {}};
  if (!names.empty())
    for (std::size_t i = 2; i < 5 && named.missing.empty(); ++i)
      if (named.columns[i] < 0)
        named.missing = "the header names columns x and y but none for " +
                        std::string(i == 2 ? "z" : (i == 3 ? "the dip (dip, inclination)" : "azimuth (dip_direction) or strike"));
  return named;
}

const TableKind& dipTable() {
  static const TableKind kind{"table of dips", "dip measurement", {"x", "y", "z", "dip", "azimuth"}, dipColumns};
  return kind;
}

bool isNullAngle(double angle) {
  return isNullValue(angle) || (angle != 0.0 && isNullCode(angle));
}

std::string degrees(double angle) {
  std::string text = std::to_string(angle);
  text.erase(text.find_last_not_of('0') + 1);
  return text.back() == '.' ? text.substr(0, text.size() - 1) : text;
}

class DipTable {
public:
  DipTable(std::string_view text, const PickFile& file)
      : layout_(findLayout(text, file.path, dipTable()))
      , strike_(layout_.names_used && findDipColumns(layout_.names).azimuth < 0)
      , source_(tableSource(layout_.body, layout_.first_line, file)) {
    picks_.source = file.path;
  }

  /// Places and normals; null values are still in.
  PickSet read() {
    const TableLayout<5> columns = tableLayoutOf<5>(layout_);
    const Table<5> table = readTable<5>(source_, columns);
    noteColumns(layout_, dipTable(), picks_.notes);
    judgeBadRows(table.bad_lines, table.last_line, dipTable(), picks_);
    for (std::size_t i = 0; i < table.rows.size(); ++i)
      add(table.rows[i], i, columns);
    return std::move(picks_);
  }

private:
  void add(const Row& row, std::size_t index, const TableLayout<5>& columns) {
    picks_.points.push_back(row.head<3>());
    picks_.normals.push_back(Vector3::UnitZ());
    if (isNullAngle(row[3]) || isNullAngle(row[4])) {
      picks_.points.back().z() = std::numeric_limits<double>::quiet_NaN();
      return;
    }
    const bool dip_fits = row[3] >= 0.0 && row[3] <= 90.0;
    if (!dip_fits || !(row[4] >= -180.0 && row[4] <= 360.0)) {
      const std::string direction = strike_ ? "strike" : "azimuth";
      throw ParseError(picks_.source, lineOfRow(source_, columns, index),
                       dip_fits ? direction + " " + degrees(row[4]) + " is not within 0 to 360 or -180 to 180 degrees"
                                : "dip " + degrees(row[3]) + " is not within 0 to 90 degrees" +
                                      (layout_.names_used ? "" : "; without column names the order is x y z dip azimuth"));
    }
    picks_.normals.back() = strike_ ? normalOf(StrikeDip{row[4], row[3]}) : normalOf(DipAzimuth{row[3], row[4]});
  }

  TextLayout layout_;
  bool strike_; ///< the direction is a strike
  TableSource source_;
  PickSet picks_;
};

} // namespace

DipSet readDips(const std::string& path, const ReadOptions& options) {
  const FileContent content(path);
  if (content.bytes().empty())
    throw ParseError(path, 0, "the file is empty");
  const FileFormat format = formatOf(content.bytes(), path);
  if (format != FileFormat::Text)
    throw ParseError(path, 0, "is " + describe(format) + ", not a table of dips (text x y z dip azimuth, or x y z strike dip)");
  std::string storage;
  PickSet rows = DipTable(textOf(content, path, storage), {content, path, options}).read();
  dropNoData(rows, {false, options.nulls, options.threads, options.recognise_nulls});
  if (rows.points.empty())
    throw ParseError(path, 0, "is no table of dips: no row holds data");
  DipSet set;
  set.dips.reserve(rows.points.size());
  for (std::size_t i = 0; i < rows.points.size(); ++i)
    set.dips.push_back({rows.points[i], rows.normals[i]});
  set.source = path;
  set.rejected_rows = rows.rejected_rows;
  set.no_data_rows = rows.no_data_rows;
  set.notes = std::move(rows.notes);
  return set;
}

} // namespace graben
