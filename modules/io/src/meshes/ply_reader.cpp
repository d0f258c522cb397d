#include "content/binary_columns.h"
#include "content/file_content.h"
#include "meshes/mesh_formats.h"
#include "meshes/ply_body.h"
#include "picks/pick_formats.h"

#include "graben/core/errors.h"
#include "graben/core/threads.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>

namespace graben {
namespace {

constexpr std::size_t most_vertices = std::numeric_limits<Index>::max();

/// Where a vertex property goes: a coordinate, a component of the normal, the piece, a named scalar
/// or nowhere.
struct Target {
  enum class Kind { Position, Normal, Piece, Scalar } kind = Kind::Scalar;
  int component = 0;
  std::vector<float>* scalar = nullptr;
};

class PlyReader {
public:
  /// \param[in] picks the file as one of picks, without faces; null for a mesh
  PlyReader(std::string_view bytes, const std::string& path, const PickFile* picks)
      : path_(path)
      , header_(readPlyHeader(bytes, path))
      , body_(bytes, header_, path)
      , picks_(picks)
      , with_faces_(picks == nullptr) {}

  MeshInput read();

private:
  [[noreturn]] void fail(const std::string& message) const { throw ParseError(path_, 0, message); }
  std::vector<Target> targetsOf(const PlyElement& element);
  void readVertices(const PlyElement& element);
  bool readBinaryVertices(const PlyElement& element, const std::vector<Target>& targets);
  bool readTextVertices(const PlyElement& element, const std::vector<Target>& targets);
  void readValues(const PlyElement& element, const std::vector<Target>& targets);
  bool readBinaryTriangles(const PlyElement& element);
  void readFaces(const PlyElement& element);
  void addPolygon(const std::vector<double>& corners);
  void refuseMore();
  void note();

  const std::string& path_;
  PlyHeader header_;
  PlyBody body_;
  const PickFile* picks_;
  bool with_faces_;
  MeshInput input_;
  std::vector<std::string> ignored_;
  std::size_t polygons_ = 0;
  bool has_vertices_ = false;
};

const PlyProperty* find(const PlyElement& element, std::string_view name) {
  for (const PlyProperty& p : element.properties)
    if (p.name == name && !p.is_list)
      return &p;
  return nullptr;
}

bool hasNumbersOnly(const PlyElement& element) {
  return std::none_of(element.properties.begin(), element.properties.end(), [](const PlyProperty& p) { return p.is_list; });
}

std::vector<Target> PlyReader::targetsOf(const PlyElement& element) {
  static const std::array<std::string_view, 3> positions = {"x", "y", "z"};
  static const std::array<std::array<std::string_view, 3>, 2> normals = {
      {{"nx", "ny", "nz"}, {"normal_x", "normal_y", "normal_z"}}};
  std::vector<Target> targets;
  for (const PlyProperty& p : element.properties) {
    Target target;
    const auto position = std::find(positions.begin(), positions.end(), p.name);
    if (position != positions.end() && !p.is_list) {
      target = {Target::Kind::Position, static_cast<int>(position - positions.begin()), nullptr};
    } else if (p.name == "piece" && !p.is_list && with_faces_) {
      target.kind = Target::Kind::Piece;
    } else if (!p.is_list && with_faces_) {
      target.scalar = &input_.mesh.scalars[p.name];
    } else {
      ignored_.push_back(p.name);
    }
    targets.push_back(target);
  }
  for (const auto& names : normals) {
    const bool complete = std::all_of(names.begin(), names.end(), [&](std::string_view name) {
      return find(element, name) != nullptr;
    });
    for (std::size_t i = 0; complete && i < targets.size(); ++i) {
      const std::string& name = element.properties[i].name;
      const auto normal = std::find(names.begin(), names.end(), name);
      if (normal == names.end())
        continue;
      targets[i] = {Target::Kind::Normal, static_cast<int>(normal - names.begin()), nullptr};
      input_.mesh.scalars.erase(name);
      ignored_.erase(std::remove(ignored_.begin(), ignored_.end(), name), ignored_.end());
      input_.mesh.normals.resize(element.count);
    }
    if (complete)
      break;
  }
  return targets;
}

void PlyReader::readVertices(const PlyElement& element) {
  for (const std::string_view name : {"x", "y", "z"})
    if (find(element, name) == nullptr)
      fail("the PLY vertices have no property " + std::string(name));
  if (element.count > most_vertices)
    fail("more vertices than can be numbered");
  has_vertices_ = true;
  TriangleMesh& mesh = input_.mesh;
  const std::vector<Target> targets = targetsOf(element);
  if (with_faces_ && find(element, "piece") != nullptr)
    mesh.piece.resize(element.count);
  for (auto& scalar : mesh.scalars)
    scalar.second.resize(element.count);
  if (!readBinaryVertices(element, targets) && !readTextVertices(element, targets))
    readValues(element, targets);
}

/// Vertices of numbers alone, each as long as the other.
bool PlyReader::readBinaryVertices(const PlyElement& element, const std::vector<Target>& targets) {
  if (header_.encoding == PlyEncoding::Ascii || !hasNumbersOnly(element))
    return false;
  const std::size_t stride = std::accumulate(element.properties.begin(), element.properties.end(), std::size_t{0},
                                             [](std::size_t sum, const PlyProperty& p) { return sum + sizeOf(p.type); });
  TriangleMesh& mesh = input_.mesh;
  std::vector<BinaryVectors> vectors = {{{}, &mesh.vertices}};
  if (!mesh.normals.empty())
    vectors.push_back({{}, &mesh.normals});
  std::vector<std::pair<BinaryColumn, const Target*>> others;
  const char* first = body_.take(element.count, stride);
  const char* at = first;
  for (std::size_t p = 0; p < targets.size(); ++p) {
    const BinaryColumn column{at, stride, element.properties[p].type, header_.encoding == PlyEncoding::BigEndian};
    at += sizeOf(column.type);
    const Target& target = targets[p];
    if (target.kind == Target::Kind::Position || target.kind == Target::Kind::Normal)
      vectors[target.kind == Target::Kind::Position ? 0 : 1].columns[static_cast<std::size_t>(target.component)] = column;
    else
      others.emplace_back(column, &target);
  }
  BinaryRows rows;
  rows.count = element.count;
  if (picks_ != nullptr) {
    rows = BinaryRows::inFile(picks_->content, first, stride, element.count);
    rows.threads = picks_->options.threads;
  }
  readVectors(rows, vectors);
  if (with_faces_)
    forRows(rows, [&](std::size_t begin, std::size_t end) {
      for (const auto& [column, target] : others) {
        if (target->kind == Target::Kind::Piece)
          readColumn(column, begin, end, mesh.piece.data() + begin);
        else if (target->scalar != nullptr)
          readColumn(column, begin, end, target->scalar->data() + begin);
      }
    });
  return true;
}

/// Picks as nearly all ascii files have them: a line for each.
bool PlyReader::readTextVertices(const PlyElement& element, const std::vector<Target>& targets) {
  if (header_.encoding != PlyEncoding::Ascii || !hasNumbersOnly(element) || picks_ == nullptr)
    return false;
  TableLayout<6> six;
  TableLayout<3> three;
  for (std::size_t p = 0; p < targets.size(); ++p) {
    const auto component = static_cast<std::size_t>(targets[p].component);
    if (targets[p].kind == Target::Kind::Position)
      six.columns[component] = three.columns[component] = static_cast<int>(p);
    else if (targets[p].kind == Target::Kind::Normal)
      six.columns[3 + component] = static_cast<int>(p);
  }
  six.columns_in_row = three.columns_in_row = targets.size();
  const bool last = &element == &header_.elements.back();
  const std::string_view lines = last ? body_.rest() : body_.lines(element.count);
  const TableSource source = tableSource(lines, header_.body_line, *picks_);
  PickSet picks;
  bool whole = false;
  if (input_.mesh.normals.empty()) {
    Table<3> table = readTable<3>(source, three);
    whole = table.bad_lines.empty() && table.rows.size() == element.count;
    picks.points = std::move(table.rows);
  } else {
    const Table<6> table = readTable<6>(source, six);
    whole = table.bad_lines.empty() && table.rows.size() == element.count;
    if (whole)
      splitRows(table.rows, picks_->options.threads, picks);
  }
  if (whole) {
    body_.pass(lines);
    input_.mesh.vertices = std::move(picks.points);
    input_.mesh.normals = std::move(picks.normals);
  }
  return whole;
}

void PlyReader::readValues(const PlyElement& element, const std::vector<Target>& targets) {
  TriangleMesh& mesh = input_.mesh;
  mesh.vertices.resize(element.count);
  for (std::size_t v = 0; v < element.count; ++v) {
    for (std::size_t p = 0; p < targets.size(); ++p) {
      const PlyProperty& property = element.properties[p];
      const std::size_t values = property.is_list ? body_.nextListLength(property) : 1;
      double value = 0.0;
      for (std::size_t i = 0; i < values; ++i)
        value = body_.next(property.type);
      const Target& target = targets[p];
      if (target.kind == Target::Kind::Position)
        mesh.vertices[v][target.component] = value;
      else if (target.kind == Target::Kind::Normal)
        mesh.normals[v][target.component] = value;
      else if (target.kind == Target::Kind::Piece)
        mesh.piece[v] = static_cast<Index>(std::abs(value) < 2e9 ? value : 0.0);
      else if (target.scalar != nullptr)
        (*target.scalar)[v] = static_cast<float>(value);
    }
  }
}

void PlyReader::addPolygon(const std::vector<double>& corners) {
  const auto count = static_cast<double>(input_.mesh.vertices.size());
  for (const double corner : corners)
    if (!(corner >= 0.0 && corner < count))
      fail("a face names vertex " + std::to_string(static_cast<long long>(corner)) + " of " +
           std::to_string(input_.mesh.vertices.size()));
  for (std::size_t i = 2; i < corners.size(); ++i)
    input_.mesh.triangles.push_back({static_cast<Index>(corners[0]),
                                     static_cast<Index>(corners[i - 1]),
                                     static_cast<Index>(corners[i])});
  polygons_ += corners.size() > 3 ? 1 : 0;
}

/// Faces as nearly all files have them: three 32 bit corners behind a byte that says so.
bool PlyReader::readBinaryTriangles(const PlyElement& element) {
  if (header_.encoding != PlyEncoding::LittleEndian || element.properties.size() != 1)
    return false;
  const PlyProperty& list = element.properties.front();
  if (!list.is_list || (list.name != "vertex_indices" && list.name != "vertex_index") || sizeOf(list.count_type) != 1 ||
      (list.type != BinaryType::Int32 && list.type != BinaryType::UInt32))
    return false;
  constexpr std::size_t stride = 1 + 3 * sizeof(Index);
  const std::string_view bytes = body_.rest();
  if (bytes.size() / stride < element.count)
    return false;
  const auto vertices = static_cast<Index>(input_.mesh.vertices.size());
  std::vector<Triangle>& triangles = input_.mesh.triangles;
  triangles.resize(element.count);
  std::atomic<bool> good{true};
  parallelBlocks(element.count, 1 << 15, 0, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      const char* at = bytes.data() + t * stride;
      Triangle& corners = triangles[t];
      std::memcpy(corners.data(), at + 1, sizeof(corners));
      if (*at != 3 || std::any_of(corners.begin(), corners.end(), [&](Index v) { return v < 0 || v >= vertices; }))
        good = false;
    }
  });
  if (good)
    body_.take(element.count, stride);
  else
    triangles.clear();
  return good;
}

void PlyReader::readFaces(const PlyElement& element) {
  if (!has_vertices_)
    fail("the PLY faces come before the vertices");
  if (readBinaryTriangles(element))
    return;
  std::vector<double> values;
  for (std::uint64_t f = 0; f < element.count; ++f) {
    for (const PlyProperty& property : element.properties) {
      values.resize(property.is_list ? body_.nextListLength(property) : 1);
      for (double& value : values)
        value = body_.next(property.type);
      if (property.is_list &&
          (property.name == "vertex_indices" || property.name == "vertex_index"))
        addPolygon(values);
    }
  }
}

void PlyReader::note() {
  std::string list;
  for (const std::string& name : ignored_)
    list += (list.empty() ? "" : ", ") + name;
  if (!list.empty())
    input_.notes.push_back("fields ignored: " + list);
  if (polygons_ > 0)
    input_.notes.push_back(std::to_string(polygons_) + " polygons split into triangles");
}

/// More rows than the header counts are no reason to drop them.
void PlyReader::refuseMore() {
  constexpr std::size_t least = 12; // a row of three floats; less is padding
  const std::string_view rest = body_.rest();
  const bool ascii = header_.encoding == PlyEncoding::Ascii;
  const std::size_t first = rest.find_first_not_of(ascii ? std::string_view(" \t\r\n") : std::string_view("\0\n\r", 3));
  if (first != std::string_view::npos && (ascii || rest.size() >= least))
    fail("the header promises " + std::to_string(input_.mesh.vertices.size()) + " vertices" +
         (with_faces_ ? " and " + std::to_string(input_.mesh.triangles.size()) + " triangles" : "") +
         ", but the file holds more; correct its header");
}

MeshInput PlyReader::read() {
  input_.name = stemOf(path_);
  bool to_the_end = true;
  for (const PlyElement& element : header_.elements) {
    if (element.name == "vertex") {
      readVertices(element);
    } else if (element.name == "face" && with_faces_) {
      readFaces(element);
    } else {
      if (element.count > 0 && !with_faces_)
        ignored_.push_back("element " + element.name);
      to_the_end = with_faces_ || !has_vertices_;
      if (!to_the_end)
        break;
      body_.skip(element);
    }
  }
  if (!has_vertices_)
    fail("the PLY file has no vertices");
  if (to_the_end)
    refuseMore();
  if (header_.origin) {
    for (Vector3& p : input_.mesh.vertices)
      p += *header_.origin;
    input_.notes.push_back("the origin that the PLY header states was added to all positions");
  }
  note();
  return std::move(input_);
}

} // namespace

MeshInput readPlyMesh(std::string_view bytes, const std::string& path) {
  return PlyReader(bytes, path, nullptr).read();
}

PickSet readPlyPicks(const PickFile& file) {
  MeshInput input = PlyReader(file.content.bytes(), file.path, &file).read();
  PickSet picks;
  picks.points = std::move(input.mesh.vertices);
  picks.normals = std::move(input.mesh.normals);
  picks.notes = std::move(input.notes);
  return picks;
}

} // namespace graben
