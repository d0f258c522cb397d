#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace graben {

/// A table in the making out of geometries (WKT, GeoJSON): a row for each point, with the
/// attributes of its geometry before x, y and z and the number of its line behind them.
class GeometryTable {
public:
  /// \param[in] names of the attributes; those that name a coordinate are left out where the
  /// geometries have z
  explicit GeometryTable(std::vector<std::string> names)
      : names_(std::move(names)) {}

  /// Points and lines that follow belong to a geometry with these attributes.
  void begin(std::vector<std::string> attributes) { attributes_ = std::move(attributes); }

  /// The points that follow are another line, or points by themselves.
  void beginPart(bool line);

  /// \param[in] numbers x, y and z, as they are written; z may be missing
  void add(const std::vector<std::string_view>& numbers);

  bool empty() const { return rows_.empty(); }
  bool hasZ() const { return has_z_; }

  /// The table with its header, parted by semicolons.
  std::string text() const;

private:
  std::vector<std::string> names_;
  std::vector<std::string> attributes_;
  struct Row {
    std::string attributes, place;
    std::size_t part;
  };
  std::vector<Row> rows_;
  std::size_t part_ = 0;
  bool lines_ = false;
  bool has_z_ = true;
};

} // namespace graben
