#include "content/line_reader.h"
#include "content/numbers.h"
#include "maps/geometry_table.h"
#include "tables/plain_table.h"
#include "tables/table_reader.h"

#include "graben/core/errors.h"

#include <algorithm>
#include <array>

namespace graben {
namespace {

constexpr std::size_t most_header_lines = 1000;

/// Where a geometry stands in a line.
struct Wkt {
  std::size_t begin = 0, end = 0; ///< with its quotes
  std::size_t numbers = 0;        ///< of the first bracket
  bool points = false;            ///< no lines
  bool measured = false;          ///< the third number is a measure
};

bool isLetter(char c) {
  return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
}

/// The word that ends at \a end or before blanks there; \a end is then its begin.
std::string wordBefore(std::string_view line, std::size_t& end) {
  while (end > 0 && (line[end - 1] == ' ' || line[end - 1] == '\t'))
    --end;
  const std::size_t last = end;
  while (end > 0 && isLetter(line[end - 1]))
    --end;
  return toLower(line.substr(end, last - end));
}

/// The kind of a geometry in lower case and what follows its name: `z`, `m`, `zm` or nothing.
bool kindBefore(std::string_view line, std::size_t bracket, Wkt& wkt) {
  static constexpr std::array<std::string_view, 6> kinds = {
      "multilinestring", "linestring", "multipolygon", "polygon", "multipoint", "point"};
  const auto is_dimension = [](std::string_view word) {
    return word == "z" || word == "m" || word == "zm";
  };
  wkt.begin = bracket;
  std::string word = wordBefore(line, wkt.begin);
  std::string dimension;
  if (is_dimension(word)) {
    dimension = word;
    word = wordBefore(line, wkt.begin);
  }
  for (const std::string_view kind : kinds) {
    if (word.rfind(kind, 0) != 0)
      continue;
    const std::string rest = word.substr(kind.size()) + dimension;
    wkt.measured = rest == "m";
    wkt.points = kind == "point" || kind == "multipoint";
    return rest.empty() || is_dimension(rest);
  }
  return false;
}

bool findWkt(std::string_view line, Wkt& found) {
  for (std::size_t bracket = line.find('('); bracket != std::string_view::npos;
       bracket = line.find('(', bracket + 1)) {
    if (!kindBefore(line, bracket, found))
      continue;
    found.numbers = bracket;
    std::size_t depth = 0;
    for (found.end = bracket; found.end < line.size(); ++found.end) {
      depth += line[found.end] == '(' ? 1 : 0;
      if (line[found.end] == ')' && --depth == 0)
        break;
    }
    found.end = std::min(found.end + 1, line.size());
    return true;
  }
  return false;
}

/// The geometry with its quotes and what says its reference system.
void widen(std::string_view line, Wkt& wkt) {
  const std::size_t srid = toLower(line.substr(0, wkt.begin)).rfind("srid=");
  if (srid != std::string::npos)
    wkt.begin = srid;
  while (wkt.begin > 0 && line[wkt.begin - 1] == '"')
    --wkt.begin;
  while (wkt.end < line.size() && line[wkt.end] == '"')
    ++wkt.end;
}

class WktReader {
public:
  WktReader(std::string_view text, const std::string& path)
      : path_(path)
      , table_(findNames(text)) {
    LineReader reader(text);
    std::string_view line;
    while (reader.next(line)) {
      Wkt wkt;
      if (isPassedOver(line))
        continue;
      if (findWkt(line, wkt))
        take(line, wkt, reader.number());
      else if (begun_)
        throw ParseError(path_, reader.number(),
                         "no WKT geometry, as POINT Z (x y z): '" +
                             std::string(trim(line).substr(0, 60)) + "'");
    }
  }

  const GeometryTable& table() const { return table_; }

private:
  /// The attributes beside a geometry, and in which column it stands.
  std::vector<std::string> attributesOf(std::string_view line, const Wkt& wkt,
                                        std::size_t& column) const {
    std::vector<std::string> attributes;
    std::string row(line.substr(0, wkt.begin));
    row += mark;
    row += line.substr(wkt.end);
    std::vector<std::string_view> fields;
    splitFields(row, delimiter_, fields);
    for (std::size_t c = 0; c < fields.size(); ++c)
      if (fields[c].find(mark) == std::string_view::npos)
        attributes.emplace_back(fields[c]);
      else
        column = c;
    return attributes;
  }

  std::vector<std::string> findNames(std::string_view text) {
    LineReader reader(text);
    std::string_view line;
    std::string_view header;
    Wkt wkt;
    while (reader.next(line) && !(!isPassedOver(line) && findWkt(line, wkt)))
      header = trim(line).empty() ? header : line;
    widen(line, wkt);
    const std::string_view beside =
        wkt.begin > 0 ? line.substr(wkt.begin - 1, 1) : line.substr(wkt.end, 1);
    delimiter_ =
        !beside.empty() && std::string_view(",;\t|").find(beside.front()) != std::string_view::npos
            ? beside.front()
            : ' ';
    std::size_t column = 0;
    const std::vector<std::string> first = attributesOf(line, wkt, column);
    std::vector<std::string_view> names;
    splitFields(header, delimiter_, names);
    std::vector<std::string> named(names.begin(), names.end());
    if (named.size() == first.size() + 1) {
      named.erase(named.begin() + static_cast<std::ptrdiff_t>(column));
      return named;
    }
    named.assign(first.size(), "attribute");
    double value = 0.0;
    const auto text_column = std::find_if(
        first.begin(), first.end(), [&](const std::string& a) { return !parseField(a, value); });
    if (text_column != first.end())
      named[static_cast<std::size_t>(text_column - first.begin())] = "name";
    return named;
  }

  void take(std::string_view line, Wkt wkt, std::size_t number) {
    begun_ = true;
    const std::string_view body = line.substr(wkt.numbers, wkt.end - wkt.numbers);
    if (body.empty() ||
        std::count(body.begin(), body.end(), '(') != std::count(body.begin(), body.end(), ')'))
      throw ParseError(path_, number,
                       "the brackets of a WKT geometry are not closed; the file may be cut short");
    widen(line, wkt);
    std::size_t column = 0;
    table_.begin(attributesOf(line, wkt, column));
    bool part = true;
    for (std::size_t at = 0; at < body.size();) {
      const std::size_t end = std::min(body.find_first_of(",()", at), body.size());
      if (trim(body.substr(at, end - at)).empty()) {
        part |= end < body.size() && body[end] == '(';
        at = end + 1;
        continue;
      }
      if (part)
        table_.beginPart(!wkt.points);
      part = false;
      takePlace(body.substr(at, end - at), wkt.measured, number);
      at = end;
    }
  }

  void takePlace(std::string_view words, bool measured, std::size_t number) {
    std::vector<std::string_view> numbers;
    splitWords(words, numbers);
    double value = 0.0;
    if (numbers.size() < 2 || !std::all_of(numbers.begin(), numbers.end(), [&](std::string_view n) {
          return parseField(n, value);
        }))
      throw ParseError(path_, number,
                       "no numbers x y z in a WKT geometry: '" + std::string(words.substr(0, 60)) +
                           "'");
    if (measured)
      numbers.resize(2);
    table_.add(numbers);
  }

  static constexpr char mark = '\x1e';
  const std::string& path_;
  char delimiter_ = ' ';
  bool begun_ = false;
  GeometryTable table_;
};

} // namespace

bool hasWkt(std::string_view text) {
  LineReader reader(text.substr(0, 1 << 16));
  std::string_view line;
  Wkt wkt;
  for (std::size_t lines = 0; lines < most_header_lines && reader.next(line); ++lines)
    if (!isPassedOver(line) && line.find('(') != std::string_view::npos && findWkt(line, wkt)) {
      double value = 0.0;
      const std::size_t first = line.find_first_not_of(" \t(", wkt.numbers);
      return first != std::string_view::npos &&
             parseNumber(line.data() + first, line.data() + line.size(), value) != nullptr;
    }
  return false;
}

std::string tableOfWkt(std::string_view text, const std::string& path) {
  const WktReader reader(text, path);
  if (reader.table().empty())
    throw ParseError(path, 0, "holds no point of a WKT geometry");
  return reader.table().text();
}

} // namespace graben
