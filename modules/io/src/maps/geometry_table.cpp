#include "maps/geometry_table.h"

#include "tables/column_names.h"

#include <algorithm>

namespace graben {

void GeometryTable::beginPart(bool line) {
  ++part_;
  lines_ |= line;
}

void GeometryTable::add(const std::vector<std::string_view>& numbers) {
  Row row{{}, {}, part_};
  for (std::size_t c = 0; c < names_.size(); ++c) {
    std::string text = c < attributes_.size() ? attributes_[c] : std::string();
    std::replace_if(
        text.begin(), text.end(), [](char ch) { return ch == ';' || ch == '"' || ch == '\n'; },
        ' ');
    // Which columns are left out is known at the end.
    row.attributes += text + ';';
  }
  for (std::size_t k = 0; k < numbers.size() && k < 3; ++k)
    (row.place += k == 0 ? "" : ";") += numbers[k];
  has_z_ = has_z_ && numbers.size() >= 3;
  rows_.push_back(std::move(row));
}

std::string GeometryTable::text() const {
  std::vector<bool> kept(names_.size(), true);
  for (std::size_t c = 0; c < names_.size(); ++c) {
    const auto place = findCoordinateColumns({names_[c]});
    const bool coordinate = place[0] >= 0 || place[1] >= 0 || (has_z_ && place[2] >= 0);
    kept[c] = !coordinate && findColumn({names_[c]}, ColumnRole::Stick) < 0 &&
              findColumn({names_[c]}, ColumnRole::Node) < 0;
  }
  std::string table;
  for (std::size_t c = 0; c < names_.size(); ++c)
    if (kept[c])
      table += names_[c] + ';';
  table += has_z_ ? "X;Y;Z" : "X;Y";
  table += lines_ ? ";stick\n" : "\n";
  for (const Row& row : rows_) {
    std::size_t begin = 0;
    for (std::size_t c = 0; c < names_.size(); ++c) {
      const std::size_t end = row.attributes.find(';', begin) + 1;
      if (kept[c])
        table += row.attributes.substr(begin, end - begin);
      begin = end;
    }
    table += row.place;
    table += lines_ ? ";" + std::to_string(row.part) + "\n" : "\n";
  }
  return table;
}

} // namespace graben
