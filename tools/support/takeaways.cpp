#include "support/takeaways.h"

#include "graben/io/pick_writer.h"
#include "graben/io/polygon_writer.h"
#include "graben/io/table_writer.h"

#include <algorithm>
#include <cctype>
#include <cmath>

namespace graben {

namespace {

namespace fs = std::filesystem;

FaultStick closed(const Points& ring) {
  FaultStick line{ring};
  if (!ring.empty())
    line.points.push_back(ring.front());
  return line;
}

/// A table's columns, each read off the same rows.
template <typename Row>
class Columns {
public:
  explicit Columns(const std::vector<Row>& rows) : rows_(rows) {}

  template <typename Value>
  void add(const std::string& name, const std::string& unit, const Value& value) {
    std::vector<double> values;
    for (const Row& row : rows_)
      values.push_back(value(row));
    columns_.push_back({unit.empty() ? name : name + " [" + unit + "]", std::move(values)});
  }
  std::vector<TableColumn> take() { return std::move(columns_); }

private:
  const std::vector<Row>& rows_;
  std::vector<TableColumn> columns_;
};

const char* kindOf(const FaultPolygon& polygon) { return polygon.overlap ? "overlap" : "gap"; }

void writePolygonTable(const fs::path& dir, const ReconstructionResult& result) {
  std::vector<std::string> faults, kinds;
  std::vector<double> numbers, x, y, z;
  for (std::size_t i = 0; i < result.polygons.size(); ++i)
    for (const Vector3& p : closed(result.polygons[i].ring).points) {
      faults.push_back(result.faults[static_cast<std::size_t>(result.polygons[i].fault)].name);
      kinds.emplace_back(kindOf(result.polygons[i]));
      numbers.push_back(static_cast<double>(i + 1));
      x.push_back(p.x());
      y.push_back(p.y());
      z.push_back(p.z());
    }
  writeTable((dir / "fault_polygons.csv").string(),
             {{"x", std::move(x)}, {"y", std::move(y)}, {"z", std::move(z)}, {"polygon", std::move(numbers)}, {"fault", std::move(faults)},
              {"kind", std::move(kinds)}});
}

} // namespace

void declareUnitOptions(OptionParser& parser) {
  parser.value("xy-unit", "UNIT", "name of the unit of x and y, for headers and pictures (default: as the picks' file says, else m)")
    .value("z-unit", "UNIT", "name of the unit of z (default: as the picks' file says, else that of x and y; ms where --z-scale is not 1)");
}

UnitNames unitNames(const OptionValues& values, const UnitNames& of_picks) {
  for (const char* option : {"xy-unit", "z-unit"}) {
    const std::string& unit = values.text(option);
    if (unit.size() > 16 || !std::all_of(unit.begin(), unit.end(), [](unsigned char c) { return std::isalnum(c) != 0; }))
      values.refuse(option, "is no name of a unit: up to 16 letters and digits, such as m, ft or ms");
  }
  const auto first = [](std::initializer_list<std::string> names) {
    return *std::find_if(names.begin(), names.end() - 1, [](const auto& n) { return !n.empty(); });
  };
  UnitNames units;
  units.xy = first({values.text("xy-unit"), of_picks.xy, "m"});
  units.z = first({values.text("z-unit"), of_picks.z, values.number("z-scale") == 1.0 ? units.xy : "ms"});
  return units;
}

std::string fileOfFault(const std::string& what, std::size_t fault, const std::string& name) {
  constexpr std::size_t kLongest = 100;
  std::string safe = name.substr(0, kLongest);
  for (char& c : safe)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '-' && c != '_' && c != '.')
      c = '_';
  return what + "_" + std::to_string(fault + 1) + "_" + (safe.empty() ? "fault" : safe);
}

void writeThrows(const fs::path& dir, const ReconstructionResult& result, const UnitNames& units) {
  for (std::size_t f = 0; f < result.throws.size(); ++f) {
    if (result.throws[f].empty())
      continue;
    Columns<ThrowSample> columns(result.throws[f]);
    columns.add("x", units.xy, [](const ThrowSample& s) { return s.footwall.x(); });
    columns.add("y", units.xy, [](const ThrowSample& s) { return s.footwall.y(); });
    columns.add("z", units.z, [](const ThrowSample& s) { return s.footwall.z(); });
    columns.add("hanging_wall_x", units.xy, [](const ThrowSample& s) { return s.hanging_wall.x(); });
    columns.add("hanging_wall_y", units.xy, [](const ThrowSample& s) { return s.hanging_wall.y(); });
    columns.add("hanging_wall_z", units.z, [](const ThrowSample& s) { return s.hanging_wall.z(); });
    columns.add("along", units.xy, [](const ThrowSample& s) { return s.along; });
    columns.add("throw", units.z, [](const ThrowSample& s) { return s.throw_; });
    columns.add("heave", units.xy, [](const ThrowSample& s) { return s.heave; });
    columns.add("dip_slip", units.xy, [](const ThrowSample& s) { return s.dip_slip; });
    columns.add("mark", "", [](const ThrowSample& s) { return static_cast<double>(s.mark); });
    writeTable((dir / (fileOfFault("throw", f, result.faults[f].name) + ".csv")).string(), columns.take());
  }
}

void writeProfiles(const fs::path& dir, const ReconstructionResult& result, const UnitNames& units) {
  for (std::size_t f = 0; f < result.profiles.size(); ++f) {
    const std::vector<ProfileRow>& rows = result.profiles[f].rows;
    if (rows.empty())
      continue;
    Columns<ProfileRow> columns(rows);
    columns.add("along", units.xy, [](const ProfileRow& r) { return r.along; });
    columns.add("x", units.xy, [](const ProfileRow& r) { return r.footwall.x(); });
    columns.add("y", units.xy, [](const ProfileRow& r) { return r.footwall.y(); });
    columns.add("footwall_z", units.z, [](const ProfileRow& r) { return r.footwall.z(); });
    columns.add("hanging_wall_z", units.z, [](const ProfileRow& r) { return r.hanging_wall.z(); });
    columns.add("throw", units.z, [](const ProfileRow& r) { return r.throw_; });
    columns.add("throw_p10", units.z, [](const ProfileRow& r) { return r.throwAt(-kP90); });
    columns.add("throw_p90", units.z, [](const ProfileRow& r) { return r.throwAt(kP90); });
    columns.add("throw_sd", units.z, [](const ProfileRow& r) { return r.deviation; });
    columns.add("heave", units.xy, [](const ProfileRow& r) { return r.heave; });
    columns.add("heave_p10", units.xy, [](const ProfileRow& r) { return r.heave - kP90 * r.heave_deviation; });
    columns.add("heave_p90", units.xy, [](const ProfileRow& r) { return r.heave + kP90 * r.heave_deviation; });
    columns.add("dip_slip", units.xy, [](const ProfileRow& r) { return r.dip_slip; });
    columns.add("dip_slip_p10", units.xy, [](const ProfileRow& r) { return r.dip_slip - kP90 * r.dip_slip_deviation; });
    columns.add("dip_slip_p90", units.xy, [](const ProfileRow& r) { return r.dip_slip + kP90 * r.dip_slip_deviation; });
    columns.add("fault_dip", "deg", [](const ProfileRow& r) { return r.dip; });
    columns.add("fault_dip_azimuth", "deg", [](const ProfileRow& r) { return r.azimuth; });
    if (std::any_of(rows.begin(), rows.end(), [](const ProfileRow& r) { return std::isfinite(r.realized_deviation); })) {
      columns.add("realized_p10", units.z, [](const ProfileRow& r) { return r.realized_low; });
      columns.add("realized_p90", units.z, [](const ProfileRow& r) { return r.realized_high; });
      columns.add("realized_sd", units.z, [](const ProfileRow& r) { return r.realized_deviation; });
    }
    writeTable((dir / (fileOfFault("profile", f, result.faults[f].name) + ".csv")).string(), columns.take());
  }
}

void writePolygons(const fs::path& dir, const ReconstructionResult& result) {
  if (result.polygons.empty())
    return;
  writePolygonTable(dir, result);
  std::vector<MapPolygon> polygons;
  for (const FaultPolygon& p : result.polygons)
    polygons.push_back({{{"fault", result.faults[static_cast<std::size_t>(p.fault)].name}, {"kind", kindOf(p)}}, {{"area", p.area}}, p.ring});
  writeGeoJson((dir / "fault_polygons.geojson").string(), polygons);
  writeShapefile((dir / "fault_polygons.shp").string(), polygons);
  for (std::size_t f = 0; f < result.faults.size(); ++f)
    for (const bool overlap : {false, true}) {
      std::vector<FaultStick> lines;
      for (const FaultPolygon& p : result.polygons)
        if (static_cast<std::size_t>(p.fault) == f && p.overlap == overlap)
          lines.push_back(closed(p.ring));
      if (!lines.empty())
        writePol((dir / (fileOfFault(overlap ? "overlap" : "gap", f, result.faults[f].name) + ".pol")).string(), lines);
    }
}

} // namespace graben
