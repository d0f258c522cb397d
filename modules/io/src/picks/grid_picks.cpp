// Grids read as picks on their nodes: IRAP classic, Z-MAP+, GXF, CPS-3, Surfer (text, 6 and 7) and ESRI.
#include "picks/grid_picks.h"

#include "content/line_reader.h"
#include "content/numbers.h"
#include "tables/text_layout.h"

#include "graben/core/errors.h"
#include "graben/core/short_number.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>

namespace graben {
namespace {

constexpr std::size_t looked_at = 1 << 14;

/// How the nodes of a grid lie and in which order its values come.
struct Grid {
  std::string kind;
  double nx = 0.0, ny = 0.0; ///< as written
  double x0 = 0.0, y0 = 0.0; ///< of the node in the corner of least x and y, before it is turned
  double dx = 0.0, dy = 0.0;
  double turned = 0.0;           ///< degrees against the clock, about (x0, y0)
  bool column_by_column = false; ///< the values of a column of nodes come together
  bool from_east = false;
  bool from_north = false;
  std::vector<double> nulls;
  double scale = 1.0, offset = 0.0; ///< of the values
  std::string horizon;
};

class GridText {
public:
  GridText(std::string_view text, const std::string& path)
      : reader_(text)
      , path_(path) {}

  [[noreturn]] void fail(const std::string& message) const { throw ParseError(path_, reader_.number(), message); }

  /// The next line that is not empty.
  /// \returns false at the end
  bool next() {
    while (reader_.next(line_)) {
      line_ = trim(line_);
      if (!line_.empty())
        return true;
    }
    return false;
  }

  std::string_view line() const { return line_; }

  /// The words of the line, parted by blanks or commas; empty ones between commas count.
  std::vector<std::string_view> words() const {
    std::vector<std::string_view> words;
    if (line_.find(',') == std::string_view::npos) {
      splitWords(line_, words);
      return words;
    }
    for (std::size_t at = 0; at <= line_.size();) {
      const std::size_t end = std::min(line_.find(',', at), line_.size());
      words.push_back(trim(line_.substr(at, end - at)));
      at = end + 1;
    }
    return words;
  }

  /// \a count numbers of the next lines.
  std::vector<double> numbers(std::size_t count, const std::string& what) {
    std::vector<double> found;
    while (found.size() < count) {
      if (!next())
        fail("the grid's header is cut short: " + what + " missing");
      for (const std::string_view word : words()) {
        double value = 0.0;
        if (!parseField(word, value))
          fail("the grid's header needs " + what + ", not '" + std::string(line_.substr(0, 60)) + "'");
        found.push_back(value);
      }
    }
    return found;
  }

  /// All numbers to the end; words of \a width letters where they are not parted, 0: they are.
  std::vector<double> values(std::size_t width) {
    std::vector<double> found;
    std::vector<std::string_view> words;
    std::string_view line;
    while (reader_.next(line)) {
      if (width == 0)
        splitWords(line, words);
      else
        splitFixed(line, width, words);
      for (const std::string_view word : words) {
        double value = 0.0;
        if (!parseField(word, value))
          fail("no value of a grid: '" + std::string(word.substr(0, 60)) + "'");
        found.push_back(value);
      }
    }
    return found;
  }

  std::string_view rest() const { return reader_.rest(); }

private:
  static void splitFixed(std::string_view line, std::size_t width, std::vector<std::string_view>& words) {
    words.clear();
    for (; !trim(line).empty(); line.remove_prefix(std::min(width, line.size())))
      if (const std::string_view word = trim(line.substr(0, width)); !word.empty())
        words.push_back(word);
  }

  LineReader reader_;
  const std::string& path_;
  std::string_view line_;
};

/// The picks on a grid's nodes.
PickSet picksOf(const Grid& grid, const std::vector<double>& values, const std::string& path) {
  const bool good =
      grid.nx >= 1.0 && grid.ny >= 1.0 && grid.nx == std::floor(grid.nx) && grid.ny == std::floor(grid.ny) && grid.nx < 1e9 && grid.ny < 1e9;
  if (!good || !(std::abs(grid.dx) > 0.0) || !(std::abs(grid.dy) > 0.0) || !std::isfinite(grid.dx + grid.dy + grid.x0 + grid.y0 + grid.turned))
    throw ParseError(path, 0, "the " + grid.kind + " grid has an impossible size or spacing: " + shortNumber(grid.nx) + " x " + shortNumber(grid.ny) +
                                " nodes, " + shortNumber(grid.dx) + " x " + shortNumber(grid.dy) + " apart");
  const auto nx = static_cast<std::size_t>(grid.nx);
  const auto ny = static_cast<std::size_t>(grid.ny);
  if (values.size() != nx * ny)
    throw ParseError(path, 0,
                     "the " + grid.kind + " grid of " + std::to_string(nx) + " x " + std::to_string(ny) + " nodes holds " +
                         std::to_string(values.size()) + " values instead of " + std::to_string(nx * ny) +
                         (values.size() < nx * ny ? ": the file is cut short" : ""));
  PickSet picks;
  picks.points.resize(values.size());
  const double angle = grid.turned * std::acos(-1.0) / 180.0;
  const double c = grid.turned == 0.0 ? 1.0 : std::cos(angle);
  const double s = grid.turned == 0.0 ? 0.0 : std::sin(angle);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::size_t column = grid.column_by_column ? i / ny : i % nx;
    const std::size_t row = grid.column_by_column ? i % ny : i / nx;
    const double u = grid.dx * static_cast<double>(grid.from_east ? nx - 1 - column : column);
    const double v = grid.dy * static_cast<double>(grid.from_north ? ny - 1 - row : row);
    picks.points[i] = {grid.x0 + c * u - s * v, grid.y0 + s * u + c * v, values[i]};
    const bool null = std::any_of(grid.nulls.begin(), grid.nulls.end(), [&](double n) { return std::abs(values[i] - n) <= 1e-6 * std::abs(n); });
    if (null)
      picks.points[i].z() = std::nan("");
    else if (grid.scale != 1.0 || grid.offset != 0.0)
      picks.points[i].z() = grid.scale * values[i] + grid.offset;
  }
  const auto spacing = [](double d) {
    std::string text;
    appendNumber(text, std::round(std::abs(d) * 1e6) / 1e6);
    return text;
  };
  picks.format = grid.kind + " grid";
  picks.layout = std::to_string(nx) + " x " + std::to_string(ny) + " nodes, " + spacing(grid.dx) + " x " + spacing(grid.dy) + " apart";
  picks.notes.push_back("is a grid (" + grid.kind + ", " + picks.layout + "): read as picks on its nodes; a gridder may have bridged the faults");
  picks.horizon = grid.horizon;
  return picks;
}

double spacingOf(double low, double high, double nodes) {
  return nodes > 1.0 ? (high - low) / (nodes - 1.0) : 1.0;
}

PickSet readIrapGrid(std::string_view text, const std::string& path) {
  GridText in(text, path);
  const std::vector<double> head = in.numbers(4, "-996, rows and spacings");
  const std::vector<double> box = in.numbers(4, "xmin xmax ymin ymax");
  const std::vector<double> turn = in.numbers(4, "columns, rotation and its centre");
  in.numbers(7, "seven zeros");
  Grid grid;
  grid.kind = "IRAP classic";
  grid.ny = head[1];
  grid.dx = head[2];
  grid.dy = head[3];
  grid.x0 = box[0];
  grid.y0 = box[2];
  grid.nx = turn[0];
  grid.turned = turn[1];
  grid.nulls = {9999900.0};
  return picksOf(grid, in.values(0), path);
}

PickSet readZmapGrid(std::string_view text, const std::string& path) {
  GridText in(text, path);
  while (in.next() && (in.line().front() == '!' || in.line().front() != '@')) {
  }
  Grid grid;
  grid.kind = "Z-MAP+";
  if (!in.next())
    in.fail("the Z-MAP+ header is cut short");
  const auto format = in.words();
  double width = 0.0;
  double null = 0.0;
  if (format.size() < 2 || !parseField(format[0], width) || !(width >= 1.0 && width < 1000.0))
    in.fail("the Z-MAP+ header needs the width of a value and the null value");
  for (std::size_t i = 1; i < 3 && i < format.size(); ++i)
    if (!format[i].empty() && parseField(format[i], null) && std::isfinite(null))
      grid.nulls.push_back(null);
  const std::vector<double> size = in.numbers(6, "rows, columns, xmin, xmax, ymin, ymax");
  while (in.next() && in.line().front() != '@') {
  }
  grid.ny = size[0];
  grid.nx = size[1];
  grid.x0 = size[2];
  grid.y0 = size[4];
  grid.dx = spacingOf(size[2], size[3], size[1]);
  grid.dy = spacingOf(size[4], size[5], size[0]);
  grid.column_by_column = true;
  grid.from_north = true;
  GridText parted(in.rest(), path);
  const bool touching = [&] {
    GridText trial(in.rest().substr(0, looked_at), path);
    return trial.next() && trial.words().size() == 1 && trial.line().size() > static_cast<std::size_t>(width) + 2;
  }();
  return picksOf(grid, parted.values(touching ? static_cast<std::size_t>(width) : 0), path);
}

/// Where the first point of the first row lies and which way rows run, GXF revision 3.
void setSense(Grid& grid, double sense) {
  const auto s = static_cast<int>(sense);
  grid.column_by_column = s == -1 || s == 2 || s == -3 || s == 4;
  grid.from_north = s == 2 || s == -2 || s == 3 || s == -3;
  grid.from_east = s == 3 || s == -3 || s == 4 || s == -4;
}

PickSet readGxfGrid(std::string_view text, const std::string& path) {
  GridText in(text, path);
  Grid grid;
  grid.kind = "GXF";
  std::map<std::string, std::vector<double>> entries;
  while (in.next()) {
    if (in.line().front() != '#')
      continue;
    std::vector<std::string_view> words;
    splitWords(in.line().substr(1), words);
    const std::string key = words.empty() ? "" : toLower(words[0]);
    if (key == "grid")
      break;
    const bool wanted = key == "points" || key == "rows" || key == "ptseparation" || key == "rwseparation" || key == "xorigin" || key == "yorigin" ||
                        key == "rotation" || key == "dummy" || key == "sense" || key == "transform" || key == "gtype";
    if (wanted)
      entries[key] = in.numbers(1, "a number for #" + key);
  }
  const auto entry = [&](const std::string& key, double otherwise) { return entries.count(key) != 0 ? entries[key][0] : otherwise; };
  if (entry("gtype", 0.0) != 0.0)
    in.fail("a compressed GXF grid (#GTYPE) cannot be read; write it without compression");
  for (const char* key : {"points", "rows"})
    if (entries.count(key) == 0)
      in.fail("the GXF header has no #" + std::string(key));
  setSense(grid, entry("sense", 1.0));
  grid.nx = entry("points", 0.0);
  grid.ny = entry("rows", 0.0);
  grid.dx = entry("ptseparation", 1.0);
  grid.dy = entry("rwseparation", 1.0);
  if (grid.column_by_column) {
    std::swap(grid.nx, grid.ny);
    std::swap(grid.dx, grid.dy);
  }
  grid.x0 = entry("xorigin", 0.0);
  grid.y0 = entry("yorigin", 0.0);
  grid.turned = entry("rotation", 0.0);
  if (entries.count("dummy") != 0)
    grid.nulls = {entries["dummy"][0]};
  if (entries.count("transform") != 0 && entries["transform"].size() > 1) {
    grid.scale = entries["transform"][0];
    grid.offset = entries["transform"][1];
  }
  return picksOf(grid, in.values(0), path);
}

PickSet readCps3Grid(std::string_view text, const std::string& path) {
  GridText in(text, path);
  Grid grid;
  grid.kind = "CPS-3";
  std::vector<double> box;
  while (in.next() && in.line().substr(0, 2) != "->") {
    const auto words = in.words();
    std::vector<double> numbers;
    for (std::size_t i = 1; i < words.size(); ++i) {
      double value = 0.0;
      if (parseField(words[i], value))
        numbers.push_back(value);
    }
    const auto need = [&](std::size_t count) {
      if (numbers.size() < count)
        in.fail("the CPS-3 header entry " + std::string(words[0]) + " needs " + std::to_string(count) + " numbers");
    };
    if (words[0] == "FSASCI" && !numbers.empty()) {
      grid.nulls = {numbers.back()};
    } else if (words[0] == "FSLIMI") {
      need(4);
      box = numbers;
    } else if (words[0] == "FSNROW") {
      need(2);
      grid.ny = numbers[0];
      grid.nx = numbers[1];
    } else if (words[0] == "FSXINC") {
      need(2);
      grid.dx = numbers[0];
      grid.dy = numbers[1];
    }
  }
  if (box.empty())
    in.fail("the CPS-3 header has no FSLIMI");
  if (in.line().substr(0, 2) == "->")
    grid.horizon = trim(in.line().substr(2));
  grid.x0 = box[0];
  grid.y0 = box[2];
  if (grid.dx == 0.0)
    grid.dx = spacingOf(box[0], box[1], grid.nx);
  if (grid.dy == 0.0)
    grid.dy = spacingOf(box[2], box[3], grid.ny);
  grid.column_by_column = true;
  grid.from_north = true;
  return picksOf(grid, in.values(0), path);
}

PickSet readSurferText(std::string_view text, const std::string& path) {
  GridText in(text, path);
  in.next();
  const std::vector<double> size = in.numbers(2, "columns and rows");
  const std::vector<double> box = in.numbers(6, "the limits of x, y and z");
  Grid grid;
  grid.kind = "Surfer";
  grid.nx = size[0];
  grid.ny = size[1];
  grid.x0 = box[0];
  grid.y0 = box[2];
  grid.dx = spacingOf(box[0], box[1], grid.nx);
  grid.dy = spacingOf(box[2], box[3], grid.ny);
  return picksOf(grid, in.values(0), path);
}

template <typename Number>
Number take(std::string_view& bytes, const std::string& path) {
  Number value{};
  if (bytes.size() < sizeof(value))
    throw ParseError(path, 0, "the Surfer grid is cut short");
  std::memcpy(&value, bytes.data(), sizeof(value));
  bytes.remove_prefix(sizeof(value));
  return value;
}

template <typename Number>
std::vector<double> takeAll(std::string_view bytes, const std::string& path) {
  std::vector<double> values;
  while (bytes.size() >= sizeof(Number))
    values.push_back(static_cast<double>(take<Number>(bytes, path)));
  return values;
}

PickSet readSurfer6(std::string_view bytes, const std::string& path) {
  bytes.remove_prefix(4);
  Grid grid;
  grid.kind = "Surfer 6";
  grid.nx = take<std::int16_t>(bytes, path);
  grid.ny = take<std::int16_t>(bytes, path);
  std::array<double, 6> box{};
  for (double& limit : box)
    limit = take<double>(bytes, path);
  grid.x0 = box[0];
  grid.y0 = box[2];
  grid.dx = spacingOf(box[0], box[1], grid.nx);
  grid.dy = spacingOf(box[2], box[3], grid.ny);
  return picksOf(grid, takeAll<float>(bytes, path), path);
}

PickSet readSurfer7(std::string_view bytes, const std::string& path) {
  Grid grid;
  grid.kind = "Surfer 7";
  std::vector<double> values;
  while (bytes.size() >= 8) {
    const std::string tag(bytes.substr(0, 4));
    bytes.remove_prefix(4);
    const auto size = static_cast<std::size_t>(take<std::uint32_t>(bytes, path));
    std::string_view section = bytes.substr(0, size);
    bytes.remove_prefix(std::min(size, bytes.size()));
    if (tag == "GRID") {
      grid.ny = take<std::int32_t>(section, path);
      grid.nx = take<std::int32_t>(section, path);
      for (double* value : {&grid.x0, &grid.y0, &grid.dx, &grid.dy})
        *value = take<double>(section, path);
      take<double>(section, path);
      take<double>(section, path);
      grid.turned = take<double>(section, path);
      grid.nulls = {take<double>(section, path)};
    } else if (tag == "DATA") {
      values = takeAll<double>(section, path);
    }
  }
  return picksOf(grid, values, path);
}

PickSet readEsriGrid(std::string_view text, const std::string& path) {
  GridText in(text, path);
  std::map<std::string, double> entries;
  std::string_view body = in.rest();
  while (in.next()) {
    const auto words = in.words();
    double value = 0.0;
    if (words.size() != 2 || parseField(words[0], value))
      break;
    if (!parseField(words[1], value))
      in.fail("the ESRI grid's header entry " + std::string(words[0]) + " needs a number");
    entries[toLower(words[0])] = value;
    body = in.rest();
  }
  const auto entry = [&](const std::string& key, double otherwise) { return entries.count(key) != 0 ? entries[key] : otherwise; };
  Grid grid;
  grid.kind = "ESRI";
  grid.nx = entry("ncols", 0.0);
  grid.ny = entry("nrows", 0.0);
  grid.dx = entry("dx", entry("cellsize", 0.0));
  grid.dy = entry("dy", entry("cellsize", 0.0));
  grid.x0 = entries.count("xllcenter") != 0 ? entries["xllcenter"] : entry("xllcorner", 0.0) + 0.5 * grid.dx;
  grid.y0 = entries.count("yllcenter") != 0 ? entries["yllcenter"] : entry("yllcorner", 0.0) + 0.5 * grid.dy;
  grid.from_north = true;
  grid.nulls = {entry("nodata_value", -9999.0)};
  return picksOf(grid, GridText(body, path).values(0), path);
}

std::string firstWord(std::string_view text) {
  std::vector<std::string_view> words;
  LineReader reader(text);
  std::string_view line;
  while (words.empty() && reader.next(line))
    splitWords(line, words);
  return words.empty() ? "" : std::string(words[0]);
}

bool isZmapGrid(std::string_view start) {
  LineReader reader(start);
  std::string_view line;
  while (reader.next(line)) {
    line = trim(line);
    if (!line.empty() && line.front() == '@')
      return toLower(line).find("grid") != std::string::npos && line.find(',') != std::string_view::npos;
    if (!line.empty() && line.front() != '!')
      return false;
  }
  return false;
}

bool isGxfGrid(std::string_view start) {
  const std::string lower = toLower(start);
  const auto has = [&](const char* key) { return lower.rfind(key, 0) == 0 || lower.find(std::string("\n") + key) != std::string::npos; };
  return has("#points") && has("#rows") && has("#grid");
}

} // namespace

GridKind gridKindOf(std::string_view bytes) {
  for (const auto& [tag, kind] :
       {std::pair{"DSAA", GridKind::SurferText}, std::pair{"DSBB", GridKind::Surfer6}, std::pair{"DSRB", GridKind::Surfer7}})
    if (bytes.substr(0, 4) == tag)
      return kind;
  const std::string_view start = bytes.substr(0, looked_at);
  const std::string first = firstWord(start);
  double number = 0.0;
  if (parseField(first, number) && number == -996.0)
    return GridKind::Irap;
  if (first == "FSASCI")
    return GridKind::Cps3;
  if (toLower(first) == "ncols")
    return GridKind::Esri;
  if (isZmapGrid(start))
    return GridKind::Zmap;
  return isGxfGrid(start) ? GridKind::Gxf : GridKind::None;
}

PickSet readGridPicks(const PickFile& file) {
  const std::string_view bytes = file.content.bytes();
  std::string storage;
  const auto text = [&] { return textOf(file.content, file.path, storage); };
  std::string points;
  const auto blank_parted = [&] { // commas are decimals there
    const std::string_view all = text();
    return hasDecimalCommas(all) ? std::string_view(points = withDecimalPoints(all)) : all;
  };
  switch (gridKindOf(bytes)) {
  case GridKind::Irap: return readIrapGrid(blank_parted(), file.path);
  case GridKind::Zmap: return readZmapGrid(text(), file.path);
  case GridKind::Gxf: return readGxfGrid(text(), file.path);
  case GridKind::Cps3: return readCps3Grid(text(), file.path);
  case GridKind::SurferText: return readSurferText(blank_parted(), file.path);
  case GridKind::Surfer6: return readSurfer6(bytes, file.path);
  case GridKind::Surfer7: return readSurfer7(bytes, file.path);
  case GridKind::Esri: return readEsriGrid(blank_parted(), file.path);
  case GridKind::None: break;
  }
  throw ParseError(file.path, 0, "is no grid of a kind known here");
}

} // namespace graben
