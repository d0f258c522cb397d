#include "column_names.h"

#include "numbers.h"
#include "table_reader.h"

#include <algorithm>
#include <map>

namespace graben {
namespace {

constexpr std::size_t most_columns = 1000;

std::string_view withoutCommentMark(std::string_view line) {
  line = trim(line);
  const std::size_t mark = line.substr(0, 2) == "//" ? 2 : line.find_first_not_of("#!@");
  return mark == std::string_view::npos ? std::string_view{} : trim(line.substr(mark));
}

/// `1: X` or `Field: 1 x meters`: the column, from 0, and its name; false if the line is neither.
bool numberedName(std::string_view line, std::size_t& column, std::string& name) {
  const bool earth_vision = toLower(line.substr(0, 6)) == "field:";
  if (earth_vision)
    line = trim(line.substr(6));
  const std::size_t end = line.find_first_of(earth_vision ? " \t" : ":");
  std::int64_t number = 0;
  if (end == std::string_view::npos || !parseInteger(trim(line.substr(0, end)), number))
    return false;
  if (number < 1 || number > static_cast<std::int64_t>(most_columns))
    return false;
  column = static_cast<std::size_t>(number) - 1;
  const std::string_view rest = trim(line.substr(end + 1));
  name = earth_vision ? rest.substr(0, rest.find_first_of(" \t")) : rest;
  return true;
}

std::vector<std::string> numberedNames(const std::vector<std::string_view>& header) {
  std::map<std::size_t, std::string> named;
  for (const std::string_view line : header) {
    std::size_t column = 0;
    std::string name;
    if (numberedName(withoutCommentMark(line), column, name))
      named[column] = name;
  }
  std::vector<std::string> names;
  if (!named.empty())
    names.resize(named.rbegin()->first + 1);
  for (const auto& [column, name] : named)
    names[column] = name;
  return names;
}

/// Lower case, letters and digits only; what stands in brackets (units) is left off.
std::string plainName(std::string_view name) {
  std::string plain;
  for (const char c : toLower(name.substr(0, name.find_first_of("([{"))))
    if ((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9'))
      plain += c;
  return plain;
}

bool isOneOf(const std::string& name, const std::vector<std::string>& list) {
  return std::find(list.begin(), list.end(), name) != list.end();
}

bool isX(const std::string& name) {
  return isOneOf(name, {"x",          "easting", "eastings", "east",    "e",       "xutme",
                        "utmx",       "utme",    "xutm",     "xcoord",  "coordx",  "xcoordinate",
                        "cdpx",       "px",      "pointx",   "pointsx", "points0", "worldx",
                        "realworldx", "xm",      "xeasting", "xft"});
}

bool isY(const std::string& name) {
  return isOneOf(name, {"y",          "northing", "northings", "north",   "n",       "yutmn",
                        "utmy",       "utmn",     "yutm",      "ycoord",  "coordy",  "ycoordinate",
                        "cdpy",       "py",       "pointy",    "pointsy", "points1", "worldy",
                        "realworldy", "ym",       "ynorthing", "yft"});
}

/// How well a name fits z: 0 not at all, 3 exactly.
int rankAsZ(const std::string& name) {
  if (name == "z")
    return 3;
  if (isOneOf(name, {"ztvdss", "ztvd", "zcoord", "coordz", "zcoordinate", "pz", "pointz", "pointsz",
                     "points2", "worldz", "realworldz", "zm", "zft", "zms", "zvalue", "zdepth",
                     "ztime", "zelevation"}))
    return 2;
  return isOneOf(name, {"depth", "tvdss", "tvd", "elevation", "elev", "twt", "time", "height",
                        "altitude", "msl"})
             ? 1
             : 0;
}

char delimiterOf(std::string_view line) {
  for (const char c : {';', ',', '\t'})
    if (line.find(c) != std::string_view::npos)
      return c;
  return ' ';
}

} // namespace

std::array<int, 3> findCoordinateColumns(const std::vector<std::string>& names) {
  std::array<int, 3> columns{-1, -1, -1};
  int best_z = 0;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string name = plainName(names[i]);
    if (columns[0] < 0 && isX(name))
      columns[0] = static_cast<int>(i);
    else if (columns[1] < 0 && isY(name))
      columns[1] = static_cast<int>(i);
    else if (rankAsZ(name) > best_z) {
      best_z = rankAsZ(name);
      columns[2] = static_cast<int>(i);
    }
  }
  return columns;
}

DipColumns findDipColumns(const std::vector<std::string>& names) {
  static const std::vector<std::string> dip = {"dip", "dipangle", "dipamount", "dipdeg", "dipdegrees", "truedip", "inclination", "incl"};
  static const std::vector<std::string> azimuth = {"azimuth", "azim", "azi", "az", "dipazimuth", "dipazim", "dipazi", "dipaz",
                                                   "dipdirection", "dipdir", "dipdirn", "dd", "azimuthdeg", "dipazimuthdeg"};
  static const std::vector<std::string> strike = {"strike", "strikerhr", "strikeazimuth", "strikeazi", "strikedir", "strikedirection",
                                                  "strikedeg"};
  DipColumns columns;
  const auto take = [](int& column, const std::string& name, const std::vector<std::string>& list, std::size_t i) {
    if (column < 0 && isOneOf(name, list))
      column = static_cast<int>(i);
  };
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string name = plainName(names[i]);
    take(columns.dip, name, dip, i);
    take(columns.azimuth, name, azimuth, i);
    take(columns.strike, name, strike, i);
  }
  return columns;
}

std::vector<std::string> columnNames(const std::vector<std::string_view>& header) {
  std::vector<std::string> names = numberedNames(header);
  const auto named = findCoordinateColumns(names);
  if (named[0] >= 0 && named[1] >= 0)
    return names;
  std::vector<std::string_view> fields;
  for (auto line = header.rbegin(); line != header.rend(); ++line) {
    const std::string_view text = withoutCommentMark(*line);
    splitFields(text, delimiterOf(text), fields);
    names.assign(fields.begin(), fields.end());
    const auto columns = findCoordinateColumns(names);
    if (columns[0] >= 0 && columns[1] >= 0)
      return names;
  }
  return {};
}

} // namespace graben
