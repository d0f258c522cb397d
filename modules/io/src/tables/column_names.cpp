#include "tables/column_names.h"

#include "content/numbers.h"
#include "tables/table_reader.h"

#include <algorithm>

namespace graben {
namespace {

constexpr std::size_t most_columns = 1000;

std::string_view withoutCommentMark(std::string_view line) {
  line = trim(line);
  const bool two = line.substr(0, 2) == "//" || line.substr(0, 2) == "--";
  const std::size_t mark = two ? 2 : (toLower(line.substr(0, 4)) == "rem " ? 4 : line.find_first_not_of("#!@%*"));
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
  name = rest;
  if (earth_vision) {
    const std::size_t word = rest.find_first_of(" \t");
    const std::string unit = word == std::string_view::npos ? "" : unitOf(trim(rest.substr(word)));
    name = std::string(rest.substr(0, word)) + (unit.empty() ? "" : " [" + unit + "]");
  }
  return true;
}

bool isOneOf(const std::string& name, const std::vector<std::string>& list) {
  return std::find(list.begin(), list.end(), name) != list.end();
}

/// The words of a name in lower case, without what is neither letter nor digit.
std::vector<std::string> wordsOf(const std::string& name) {
  std::vector<std::string> words(1);
  for (const char c : toLower(name)) {
    if ((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9'))
      words.back() += c;
    else if (!words.back().empty())
      words.emplace_back();
  }
  if (words.back().empty())
    words.pop_back();
  return words;
}

/// Lower case, letters and digits only; a unit that stands apart at the end is left off.
std::string plainName(const std::string& name) {
  const std::size_t bracket = name.find_first_of("([{");
  std::vector<std::string> words = wordsOf(name.substr(0, bracket == 0 ? std::string::npos : bracket));
  if (words.size() > 1 && !unitOf(words.back()).empty())
    words.pop_back();
  std::string plain;
  for (const std::string& word : words)
    plain += word;
  return plain;
}

bool isX(const std::string& name) {
  return isOneOf(name, {"x",      "easting",  "eastings",    "east",       "e",       "xutme",  "utmx",    "utme",    "xutm",   "utmeasting",
                        "xcoord", "coordx",   "xcoordinate", "cdpx",       "px",      "pointx", "pointsx", "points0", "worldx", "realworldx",
                        "xm",     "xeasting", "xft",         "rechtswert", "ostwert", "cmpx",   "xloc",    "rechts", "este", "leste", "est", "shapex", "gpsx"});
}

bool isY(const std::string& name) {
  return isOneOf(name, {"y",      "northing",  "northings",   "north",    "n",        "yutmn",  "utmy",    "utmn",    "yutm",   "utmnorthing",
                        "ycoord", "coordy",    "ycoordinate", "cdpy",     "py",       "pointy", "pointsy", "points1", "worldy", "realworldy",
                        "ym",     "ynorthing", "yft",         "hochwert", "nordwert", "cmpy",   "yloc",    "hoch", "norte", "nord", "shapey", "gpsy"});
}

/// How well a name fits z: 0 not at all, 3 exactly.
int rankAsZ(const std::string& name) {
  if (name == "z")
    return 3;
  if (isOneOf(name, {"shapez", "gridcode", "ztvdss",     "ztvd", "zcoord", "coordz", "zcoordinate", "pz",     "pointz", "pointsz", "points2",    "worldz",
                     "realworldz", "zm",   "zft",    "zms",    "zvalue",      "zdepth", "ztime",  "ztwt",    "zelevation", "zloc"}))
    return 2;
  return isOneOf(name, {"depth",  "tvdss",   "tvd",    "tvdsubsea", "depthss", "ssdepth",    "subsea",    "subseadepth", "depthsubsea", "elevation",
                        "elev",   "twt",     "twtms",  "twts",      "twttime", "twowaytime", "twtpicked", "owt",         "time",        "timems",
                        "depthm", "depthft", "height", "altitude",  "msl",     "surfacez",   "hohe",      "tiefe",
                        "hoehe",  "profondeur", "profundidad", "profondita", "profundidade", "diepte", "dybde", "djup", "cota", "quota"})
             ? 1
             : 0;
}

/// Names made of words for depth, time or height only: "Depth TVDSS (ft)", "Seismic TWT Time".
bool isMadeOfWordsForZ(const std::string& name) {
  static const std::vector<std::string> core = {"z", "depth", "tvd", "tvdss", "time", "twt", "owt", "elevation", "elev", "height", "subsea"};
  static const std::vector<std::string> beside = {"ss",       "sub",   "sea",    "msl",   "two",     "way",        "one",       "true",
                                                  "vertical", "value", "picked", "pick",  "seismic", "horizon",    "structure", "structural",
                                                  "level",    "mean",  "above",  "below", "datum",   "coordinate", "point"};
  std::vector<std::string> words = wordsOf(name);
  if (words.size() > 1 && !unitOf(words.back()).empty())
    words.pop_back();
  return std::any_of(words.begin(), words.end(), [](const auto& w) { return isOneOf(w, core); }) &&
         std::all_of(words.begin(), words.end(), [](const auto& w) { return isOneOf(w, core) || isOneOf(w, beside); });
}

/// The fields of a row of names; a unit in brackets that stands apart belongs to the name before it.
std::vector<std::string> rowOfNames(std::string_view line, char delimiter) {
  if (toLower(line.substr(0, 9)) == "variables" && line.find('=') != std::string_view::npos) // Tecplot
    line.remove_prefix(line.find('=') + 1);
  std::vector<std::string_view> fields;
  delimiter = line.find("\t\t") == std::string_view::npos ? delimiter : ' '; // padded with tabs
  splitFields(line, delimiter, fields);
  std::vector<std::string> names;
  bool open = false;
  for (const std::string_view field : fields) {
    const bool unit = !field.empty() && (field.front() == '(' || field.front() == '[') && !names.empty() && delimiter == ' ';
    if (unit || open)
      (names.back() += ' ') += field;
    else
      names.emplace_back(field);
    open = (unit || open) && field.find_first_of(")]") == std::string_view::npos;
  }
  return names;
}

char delimiterOf(std::string_view line) {
  for (const char c : {';', ',', '\t'})
    if (line.find(c) != std::string_view::npos)
      return c;
  return ' ';
}

bool namesPlaces(const std::vector<std::string>& names) {
  const auto columns = findCoordinateColumns(names);
  const auto both = [&](ColumnRole a, ColumnRole b) { return findColumn(names, a) >= 0 && findColumn(names, b) >= 0; };
  return (columns[0] >= 0 && columns[1] >= 0) || both(ColumnRole::Inline, ColumnRole::Crossline) || both(ColumnRole::Longitude, ColumnRole::Latitude);
}

const std::vector<std::string>& namesOf(ColumnRole role) {
  static const std::map<ColumnRole, std::vector<std::string>> names = {
      {ColumnRole::Inline, {"inline", "il", "iline", "inlineno", "inlinenumber", "inlinenr", "linenumber3d"}},
      {ColumnRole::Crossline,
       {"crossline", "xl", "xline", "crosslineno", "crosslinenumber", "xlinenumber", "crosslinenr", "trace", "tracenumber", "cdp"}},
      {ColumnRole::Longitude, {"lon", "long", "longitude", "lng", "londeg", "longdeg", "longitudedeg", "lonwgs84", "longitudewgs84"}},
      {ColumnRole::Latitude, {"lat", "latitude", "latdeg", "latitudedeg", "latwgs84", "latitudewgs84"}},
      {ColumnRole::Horizon,
       {"horizon",   "horizonname", "horizonid",      "horizonno", "horizonnr", "horizonnumber", "horid",     "horno", "horizons", "surface",
        "surfaceid", "surfacename", "interpretation", "hor",       "horname",   "marker",        "formation", "top",   "topname"}},
      {ColumnRole::Fault, {"fault", "faultname", "name", "faultid", "faultno", "faultnr", "object", "objectname", "feature", "featurename"}},
      {ColumnRole::Stick, {"stick",      "sticknr", "stickno",    "stickid",      "sticknumber", "stickindex", "stickidx", "segment", "segid",
                           "segmentid",  "segi",    "polyid",     "poly",         "polygon",     "polygonid",  "line",     "lineid",  "polyline",
                           "polylineid", "sticks",  "faultstick", "faultstickid", "segno",       "part",       "partid",
                            "lineno",     "linenr",  "linenumber"}},
      {ColumnRole::Node,
       {"node", "nodenr", "nodeno", "nodeid", "nodenumber", "nodeindex", "knot", "knotnr", "vertex", "vertexid", "pointid", "pointno", "pointnr", "pt",
        "sequence", "seq", "order"}}};
  return names.at(role);
}

} // namespace

void HeaderNames::addNumbered(std::string_view text) {
  std::size_t column = 0;
  std::string name;
  if (numberedName(text, column, name))
    numbered_[column] = name;
}

/// A line with a number, then so many lines with a name each (GSLIB, SGeMS).
void HeaderNames::addListed(std::string_view text) {
  std::int64_t count = 0;
  if (parseInteger(text, count) && count > 0 && count <= static_cast<std::int64_t>(most_columns)) {
    listed_count_ = static_cast<std::size_t>(count);
    listed_.clear();
  } else if (listed_.size() < listed_count_) {
    listed_.emplace_back(text);
  }
}

void HeaderNames::addFact(std::string_view text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string_view::npos)
    return;
  const std::string key = toLower(trim(text.substr(0, colon)));
  const std::string_view value = trim(text.substr(colon + 1));
  double number = 0.0;
  if ((key == "null_value" || key == "null" || key == "null value" || key == "nodata" || key == "no data value") && parseField(value, number))
    nulls_.push_back(number);
  else if (key == "unit in x and y direction" || key == "units")
    xy_unit_ = unitOf(value);
  else if (key == "unit in depth" || key == "unit in z direction" || key == "unit in z")
    z_unit_ = unitOf(value);
}

/// Z-MAP+ points, lines and faults: `@NAME, DATA, ...`, a line for each field that begins with its name, `@`.
bool HeaderNames::addField(std::string_view line) {
  if (!line.empty() && line.front() == '@') {
    const std::size_t comma = line.find(',');
    const std::string kind = comma == std::string_view::npos ? "" : toLower(trim(line.substr(comma + 1, line.find(',', comma + 1) - comma - 1)));
    inside_fields_ = isOneOf(kind, {"falt", "fault", "faults", "vert", "point", "cont", "poly"}) ||
                     (comma != std::string_view::npos && toLower(line).find("data") != std::string::npos);
    return true;
  }
  if (inside_fields_ && !line.empty() && line.front() != '!')
    block_.emplace_back(trim(line.substr(0, line.find(','))));
  return inside_fields_;
}

void HeaderNames::add(std::string_view line) {
  if (addField(trim(line)))
    return;
  const std::string_view text = withoutCommentMark(line);
  const std::string lower = toLower(text);
  if (lower == "begin header" || lower == "end header") {
    inside_block_ = lower == "begin header";
    if (inside_block_)
      block_.clear();
    return;
  }
  if (inside_block_) {
    const std::size_t comma = text.find(',');
    block_.emplace_back(trim(comma == std::string_view::npos ? text : text.substr(comma + 1)));
    return;
  }
  addNumbered(text);
  addFact(text);
  std::vector<std::string> row = rowOfNames(text, delimiterOf(text));
  if (row.size() == 2 && isOneOf(toLower(row[0]), {"discrete", "float", "string", "int", "double"})) {
    attributes_.push_back(row[1]);
    return;
  }
  addListed(text);
  if (namesPlaces(row))
    row_ = std::move(row);
}

std::vector<std::string> HeaderNames::names() const {
  std::vector<std::string> names;
  if (!numbered_.empty())
    names.resize(numbered_.rbegin()->first + 1);
  for (const auto& [column, name] : numbered_)
    names[column] = name;
  if (namesPlaces(names))
    return names;
  if (namesPlaces(block_))
    return block_;
  if (listed_.size() == listed_count_ && namesPlaces(listed_))
    return listed_;
  if (row_.empty() && !attributes_.empty()) {
    names = {"X", "Y", "Z"};
    names.insert(names.end(), attributes_.begin(), attributes_.end());
    return names;
  }
  return row_;
}

std::array<int, 3> findCoordinateColumns(const std::vector<std::string>& names) {
  std::array<int, 3> columns{-1, -1, -1};
  int best_z = 0;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string name = plainName(names[i]);
    const int as_z = std::max(rankAsZ(name), isMadeOfWordsForZ(names[i]) ? 1 : 0);
    if (columns[0] < 0 && isX(name))
      columns[0] = static_cast<int>(i);
    else if (columns[1] < 0 && isY(name))
      columns[1] = static_cast<int>(i);
    else if (as_z > best_z) {
      best_z = as_z;
      columns[2] = static_cast<int>(i);
    }
  }
  return columns;
}

std::string otherNameForZ(const std::vector<std::string>& names) {
  const int z = findCoordinateColumns(names)[2];
  const auto rank = [&](const std::string& name) { return std::max(rankAsZ(plainName(name)), isMadeOfWordsForZ(name) ? 1 : 0); };
  if (z < 0)
    return {};
  const std::string& taken = names[static_cast<std::size_t>(z)];
  const auto other = std::find_if(names.begin(), names.end(), [&](const std::string& name) { return &name != &taken && rank(name) == rank(taken); });
  return other == names.end() ? std::string() : *other;
}

std::string nameGivenTwice(const std::vector<std::string>& names) {
  for (const int column : findCoordinateColumns(names))
    if (column >= 0 &&
        std::count_if(names.begin(), names.end(), [&](const auto& n) { return plainName(n) == plainName(names[static_cast<std::size_t>(column)]); }) > 1)
      return names[static_cast<std::size_t>(column)];
  return {};
}

DipColumns findDipColumns(const std::vector<std::string>& names) {
  static const std::vector<std::string> dip = {"dip", "dipangle", "dipamount", "dipdeg", "dipdegrees", "truedip", "inclination", "incl"};
  static const std::vector<std::string> azimuth = {"azimuth", "azim",         "azi",    "az",      "dipazimuth", "dipazim",    "dipazi",
                                                   "dipaz",   "dipdirection", "dipdir", "dipdirn", "dd",         "azimuthdeg", "dipazimuthdeg"};
  static const std::vector<std::string> strike = {"strike", "strikerhr", "strikeazimuth", "strikeazi", "strikedir", "strikedirection", "strikedeg"};
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

int findColumn(const std::vector<std::string>& names, ColumnRole role) {
  const std::vector<std::string>& list = namesOf(role);
  const auto found = std::find_if(names.begin(), names.end(), [&](const std::string& name) { return isOneOf(plainName(name), list); });
  return found == names.end() ? -1 : static_cast<int>(found - names.begin());
}

int findColumn(const std::vector<std::string>& names, const std::string& wanted, std::size_t columns) {
  const auto by = [&](auto text) {
    const auto found = std::find_if(names.begin(), names.end(), [&](const std::string& name) { return !name.empty() && text(name) == text(wanted); });
    return found == names.end() ? -1 : static_cast<int>(found - names.begin());
  };
  int column = by([](const std::string& name) { return name; });
  if (column < 0)
    column = by([](const std::string& name) { return toLower(trim(name)); });
  std::int64_t number = 0;
  if (column < 0 && parseInteger(wanted, number))
    return number >= 1 && number <= static_cast<std::int64_t>(columns) ? static_cast<int>(number - 1) : -1;
  if (column < 0 && !plainName(wanted).empty())
    column = by([](const std::string& name) { return plainName(name); });
  return column;
}

std::string unitOf(std::string_view text) {
  static const std::map<std::string, std::string> units = {
      {"m", "m"},           {"meter", "m"},       {"meters", "m"},  {"metre", "m"}, {"metres", "m"},        {"mtr", "m"},
      {"ft", "ft"},         {"feet", "ft"},       {"foot", "ft"},   {"usft", "ft"}, {"ftus", "ft"},         {"km", "km"},
      {"kilometers", "km"}, {"kilometres", "km"}, {"ms", "ms"},     {"msec", "ms"}, {"milliseconds", "ms"}, {"s", "s"},
      {"sec", "s"},         {"second", "s"},      {"seconds", "s"}, {"us", "us"},   {"microseconds", "us"}};
  std::string plain;
  for (const char c : toLower(text))
    if ((c >= 'a' && c <= 'z'))
      plain += c;
  const auto found = units.find(plain);
  return found == units.end() ? std::string() : found->second;
}

std::string unitOfName(const std::string& name) {
  const std::vector<std::string> words = wordsOf(name);
  if (words.size() > 1 && !unitOf(words.back()).empty())
    return unitOf(words.back());
  if (words.size() == 1)
    for (const char* base : {"z", "x", "y", "depth", "twt", "time", "tvdss", "tvd", "elevation"})
      for (const char* unit : {"ms", "ft", "km", "m", "s"})
        if (words[0] == std::string(base) + unit)
          return unit;
  return {};
}

int senseOfName(const std::string& name) {
  const std::string plain = plainName(name);
  const auto holds = [&](std::initializer_list<const char*> words) {
    return std::any_of(words.begin(), words.end(), [&](const char* word) { return plain.find(word) != std::string::npos; });
  };
  if (holds({"elev", "height", "altitude", "hohe", "hoehe"}) || plain == "cota" || plain == "quota" || plain == "msl")
    return 1;
  return holds({"depth", "tvd", "twt", "time", "subsea", "tiefe", "owt", "profond", "profund", "diepte", "dybde", "djup"}) ? -1 : 0;
}

} // namespace graben
