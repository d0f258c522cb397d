// Legacy VTK polygons, versions 1 to 5.1. VTK's own reader ends the program on damaged files.
#include "content/file_content.h"
#include "content/numbers.h"
#include "meshes/mesh_formats.h"
#include "meshes/vtk_cells.h"
#include "meshes/vtk_legacy_cursor.h"

#include "graben/core/errors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace graben {
namespace {

/// Polygons or strips as VTK 5 keeps them: the corners of cell c are from offsets[c] to offsets[c + 1].
struct Cells {
  std::vector<double> offsets;
  std::vector<double> corners;
};

class VtkLegacyReader {
public:
  VtkLegacyReader(std::string_view bytes, const std::string& path)
      : cursor_(bytes, path)
      , path_(path) {}

  MeshInput read();

private:
  void readStart();
  void readSection(const std::string& key);
  void readPoints();
  Cells readCells();
  void readCellTypes();
  void addPolygons(const Cells& cells, bool strips);
  void addPolygon(const std::vector<double>& corners);
  void addGrid();
  Index corner(double value) const;
  void readAttribute(const std::string& key);
  void readScalars();
  void readField();
  void store(const std::string& name, std::size_t columns, const std::vector<double>& values,
             bool normals);
  void skipMetadata();

  VtkLegacyCursor cursor_;
  const std::string& path_;
  MeshInput input_;
  Cells cells_;                          ///< of an unstructured grid
  std::array<std::size_t, 3> grid_{};    ///< points of a structured one each way
  double version_ = 0.0;
  bool binary_ = false;
  std::size_t rows_ = 0;     ///< of the attributes that follow
  bool of_points_ = false;   ///< the attributes that follow are of points
  std::size_t polygons_ = 0; ///< with more than three corners
  std::string ignored_;
};

/// Names hold blanks as %20.
std::string decodedName(std::string_view text) {
  std::string name;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool coded = text[i] == '%' && i + 2 < text.size();
    const std::string_view digits = coded ? text.substr(i + 1, 2) : std::string_view{};
    if (coded && digits.find_first_not_of("0123456789ABCDEFabcdef") == std::string_view::npos) {
      name += static_cast<char>(std::stoi(std::string(digits), nullptr, 16));
      i += 2;
    } else {
      name += text[i];
    }
  }
  return name;
}

void VtkLegacyReader::readStart() {
  const std::string_view mark = cursor_.line();
  const std::string_view number = mark.substr(std::min(mark.size(), mark.find_last_of(' ') + 1));
  if (mark.substr(0, 14) != "# vtk DataFile" || !parseField(number, version_))
    cursor_.fail("is no legacy VTK file");
  cursor_.line(); // the title
  const std::string form = toLower(cursor_.word());
  if (form != "ascii" && form != "binary")
    cursor_.fail("a legacy VTK file must be ASCII or BINARY");
  const bool dataset = toLower(cursor_.word()) == "dataset";
  const std::string type = toLower(cursor_.word());
  if (!dataset || (type != "polydata" && type != "structured_grid" && type != "unstructured_grid"))
    cursor_.fail("is no legacy VTK file with DATASET POLYDATA, STRUCTURED_GRID or UNSTRUCTURED_GRID");
  binary_ = form == "binary";
  cursor_.setBinary(binary_);
}

void VtkLegacyReader::readPoints() {
  const std::size_t count = cursor_.count();
  const BinaryType type = cursor_.type();
  const std::vector<double> values = cursor_.numbers(count, 3, type);
  if (count > static_cast<std::size_t>(std::numeric_limits<Index>::max()))
    cursor_.fail("more vertices than can be numbered");
  input_.mesh.vertices.resize(count);
  for (std::size_t i = 0; i < count; ++i)
    input_.mesh.vertices[i] = {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
}

Cells VtkLegacyReader::readCells() {
  Cells cells;
  const std::size_t first = cursor_.count();
  const std::size_t second = cursor_.count();
  if (version_ >= 5.0) {
    cursor_.word(); // OFFSETS
    const BinaryType offset_type = cursor_.type();
    cells.offsets = cursor_.numbers(first, 1, offset_type);
    cursor_.word(); // CONNECTIVITY
    const BinaryType corner_type = cursor_.type();
    cells.corners = cursor_.numbers(second, 1, corner_type);
    return cells;
  }
  const std::vector<double> values = cursor_.numbers(second, 1, BinaryType::Int32);
  cells.offsets.push_back(0.0);
  for (std::size_t at = 0; at < values.size();) {
    const double size = values[at];
    if (!(size >= 0.0 && size < static_cast<double>(values.size() - at)))
      cursor_.fail("a polygon of " + std::to_string(size) + " corners");
    const auto corners = values.begin() + static_cast<std::ptrdiff_t>(at) + 1;
    cells.corners.insert(cells.corners.end(), corners, corners + static_cast<std::ptrdiff_t>(size));
    cells.offsets.push_back(static_cast<double>(cells.corners.size()));
    at += static_cast<std::size_t>(size) + 1;
  }
  return cells;
}

Index VtkLegacyReader::corner(double value) const {
  const std::size_t count = input_.mesh.vertices.size();
  if (!(value >= 0.0 && value < static_cast<double>(count)))
    throw ParseError(path_, 0,
                     "a polygon names vertex " + std::to_string(static_cast<long long>(value)) +
                         " of " + std::to_string(count));
  return static_cast<Index>(value);
}

void VtkLegacyReader::addPolygons(const Cells& cells, bool strips) {
  const auto most = static_cast<double>(cells.corners.size());
  for (std::size_t c = 0; c + 1 < cells.offsets.size(); ++c) {
    if (!(cells.offsets[c] >= 0.0 && cells.offsets[c] <= cells.offsets[c + 1] &&
          cells.offsets[c + 1] <= most))
      cursor_.fail("the offsets of the polygons contradict one another");
    const auto begin = static_cast<std::size_t>(cells.offsets[c]);
    const auto end = static_cast<std::size_t>(cells.offsets[c + 1]);
    polygons_ += !strips && end - begin > 3 ? 1 : 0;
    for (std::size_t i = begin + 2; i < end; ++i) {
      const Index a = corner(cells.corners[strips ? i - 2 : begin]);
      const Index b = corner(cells.corners[i - 1]);
      const Index last = corner(cells.corners[i]);
      const bool turned = strips && (i - begin) % 2 == 1;
      input_.mesh.triangles.push_back(turned ? Triangle{b, a, last} : Triangle{a, b, last});
    }
  }
}

void VtkLegacyReader::addPolygon(const std::vector<double>& corners) {
  addPolygons({{0.0, static_cast<double>(corners.size())}, corners}, false);
}

void VtkLegacyReader::readCellTypes() {
  const std::size_t count = cursor_.count();
  const std::vector<double> types = cursor_.numbers(count, 1, BinaryType::Int32);
  std::size_t others = 0;
  for (std::size_t c = 0; c < types.size() && c + 1 < cells_.offsets.size(); ++c) {
    const double begin = cells_.offsets[c];
    const double end = cells_.offsets[c + 1];
    if (!(begin >= 0.0 && begin <= end && end <= static_cast<double>(cells_.corners.size())))
      cursor_.fail("the offsets of the cells contradict one another");
    const auto at = cells_.corners.begin();
    const std::vector<double> corners(at + static_cast<std::ptrdiff_t>(begin), at + static_cast<std::ptrdiff_t>(end));
    others += addCellPolygons(static_cast<int>(types[c]), corners, [this](const auto& polygon) { addPolygon(polygon); }) ? 0 : 1;
  }
  if (others > 0)
    input_.notes.push_back(std::to_string(others) + " cells that are no polygons ignored");
}

void VtkLegacyReader::addGrid() {
  const std::size_t count = input_.mesh.vertices.size();
  const bool small = std::all_of(grid_.begin(), grid_.end(), [count](std::size_t n) { return n <= count; });
  if (!small || grid_[0] * grid_[1] * grid_[2] != count ||
      !addGridPolygons(grid_, [this](const auto& polygon) { addPolygon(polygon); }))
    throw ParseError(path_, 0, "is a structured grid of " + gridSize(grid_) + " points, not a surface of as many as it holds");
}

void VtkLegacyReader::store(const std::string& name, std::size_t columns,
                            const std::vector<double>& values, bool normals) {
  TriangleMesh& mesh = input_.mesh;
  const bool fits = of_points_ && values.size() == columns * mesh.vertices.size();
  if (fits && normals && mesh.normals.empty()) {
    for (std::size_t i = 0; i + 2 < values.size(); i += 3)
      mesh.normals.push_back({values[i], values[i + 1], values[i + 2]});
  } else if (fits && columns == 1 && name == "piece") {
    mesh.piece.clear();
    for (const double value : values)
      mesh.piece.push_back(std::abs(value) < 2e9 ? static_cast<Index>(value) : 0);
  } else if (fits && columns == 1) {
    std::vector<float>& scalar = mesh.scalars[name];
    scalar.clear();
    for (const double value : values)
      scalar.push_back(static_cast<float>(value));
  } else {
    ignored_ += (ignored_.empty() ? "" : ", ") + name;
  }
}

void VtkLegacyReader::readScalars() {
  const std::string name = decodedName(cursor_.word());
  const BinaryType type = cursor_.type();
  const std::size_t columns = cursor_.moreOnLine() ? cursor_.count() : 1;
  if (cursor_.passWord("lookup_table"))
    cursor_.word(); // the name of the table
  store(name, columns, cursor_.numbers(rows_, columns, type), false);
}

void VtkLegacyReader::readField() {
  cursor_.word(); // the name of the field
  const std::size_t arrays = cursor_.count();
  for (std::size_t a = 0; a < arrays; ++a) {
    std::string_view name = cursor_.word();
    if (name == "METADATA") {
      skipMetadata();
      name = cursor_.word();
    }
    const std::size_t columns = cursor_.count();
    const std::size_t rows = cursor_.count();
    const BinaryType type = cursor_.type();
    store(decodedName(name), columns, cursor_.numbers(rows, columns, type), false);
  }
}

/// METADATA lasts to the next empty line.
void VtkLegacyReader::skipMetadata() {
  cursor_.line();
  while (!cursor_.line().empty()) {
  }
}

void VtkLegacyReader::readAttribute(const std::string& key) {
  const std::string name = decodedName(cursor_.word());
  if (key == "lookup_table") {
    cursor_.numbers(cursor_.count(), 4, binary_ ? BinaryType::UInt8 : BinaryType::Float32);
  } else if (key == "color_scalars") {
    cursor_.numbers(rows_, cursor_.count(), binary_ ? BinaryType::UInt8 : BinaryType::Float32);
  } else if (key == "texture_coordinates") {
    const std::size_t columns = cursor_.count();
    const BinaryType type = cursor_.type();
    cursor_.numbers(rows_, columns, type);
  } else {
    const BinaryType type = cursor_.type();
    const bool single = key == "global_ids" || key == "pedigree_ids";
    const std::size_t columns = key == "tensors" ? 9 : single ? 1 : 3;
    store(name, columns, cursor_.numbers(rows_, columns, type), key == "normals");
  }
}

void VtkLegacyReader::readSection(const std::string& key) {
  static const std::vector<std::string> attributes = {
      "normals",    "vectors",      "tensors",      "texture_coordinates",
      "global_ids", "pedigree_ids", "lookup_table", "color_scalars"};
  if (key == "points") {
    readPoints();
  } else if (key == "dimensions") {
    for (std::size_t& size : grid_)
      size = cursor_.count();
  } else if (key == "cells") {
    cells_ = readCells();
  } else if (key == "cell_types") {
    readCellTypes();
  } else if (key == "polygons" || key == "triangle_strips") {
    addPolygons(readCells(), key == "triangle_strips");
  } else if (key == "vertices" || key == "lines") {
    readCells();
  } else if (key == "metadata") {
    skipMetadata();
  } else if (key == "point_data" || key == "cell_data") {
    rows_ = cursor_.count();
    of_points_ = key == "point_data";
  } else if (key == "scalars") {
    readScalars();
  } else if (key == "field") {
    readField();
  } else if (std::find(attributes.begin(), attributes.end(), key) != attributes.end()) {
    readAttribute(key);
  } else {
    cursor_.fail("unknown VTK keyword '" + key.substr(0, 40) + "'");
  }
}

MeshInput VtkLegacyReader::read() {
  readStart();
  input_.name = stemOf(path_);
  for (std::string_view key = cursor_.word(); !key.empty(); key = cursor_.word())
    readSection(toLower(key));
  if (grid_ != std::array<std::size_t, 3>{})
    addGrid();
  if (!ignored_.empty())
    input_.notes.push_back("fields ignored: " + ignored_);
  if (polygons_ > 0)
    input_.notes.push_back(std::to_string(polygons_) + " polygons split into triangles");
  return std::move(input_);
}

} // namespace

MeshInput readVtkMesh(std::string_view bytes, const std::string& path) {
  return VtkLegacyReader(bytes, path).read();
}

} // namespace graben
