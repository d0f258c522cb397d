// GOCAD TSurf: in the plain form that strict readers take (bare header, ids from 1, VRTX lines with CNXYZ, one TFACE; properties, PVRTX, are what they do
// not take, so only on demand), or in full with a TFACE per piece, properties and borders.
#include "content/numbers.h"
#include "content/row_writer.h"
#include "gocad/gocad_frame.h"
#include "meshes/mesh_formats.h"

#include "graben/core/atomic_file.h"

#include "graben/mesh/adjacency.h"
#include "graben/mesh/components.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace graben {
namespace {

/// Names end at the line's end.
std::string oneLine(std::string name) {
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return name;
}

std::string word(const std::string& name) {
  std::string text = name;
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c <= ' ' || c == '"' || c == '{' || c == '}'; }, '_');
  return text.empty() ? "scalar" : text;
}

constexpr float no_data = -99999.0F;

/// The lines that declare the properties: one number for each and vertex.
std::string propertiesOf(const TriangleMesh& mesh) {
  std::vector<std::string> names;
  if (!mesh.piece.empty())
    names.push_back("piece");
  for (const auto& scalar : mesh.scalars)
    names.push_back(word(scalar.first));
  std::array<std::string, 4> lines = {"PROPERTIES", "NO_DATA_VALUES", "PROPERTY_CLASSES", "ESIZES"};
  for (const std::string& name : names) {
    const std::array<std::string, 4> entries = {name, "-99999", name, "1"};
    for (std::size_t i = 0; i < lines.size(); ++i)
      lines[i] += " " + entries[i];
  }
  return names.empty() ? "" : lines[0] + "\n" + lines[1] + "\n" + lines[2] + "\n" + lines[3] + "\n";
}

void appendProperties(const TriangleMesh& mesh, std::size_t v, std::string& text) {
  if (!mesh.piece.empty()) {
    text += ' ';
    appendNumber(text, std::int64_t{mesh.piece[v]});
  }
  for (const auto& scalar : mesh.scalars) {
    text += ' ';
    appendNumber(text, std::isfinite(scalar.second[v]) ? scalar.second[v] : no_data);
  }
}

/// Vertices and triangles of a TFACE, as numbers in the mesh.
struct Face {
  std::vector<Index> vertices;
  std::vector<Index> triangles;
};

/// All in one face, or a face per connected piece.
std::vector<Face> facesOf(const TriangleMesh& mesh, const MeshWriteOptions& options) {
  std::vector<Face> faces(1);
  const auto vertices = static_cast<Index>(mesh.vertices.size());
  const auto triangles = static_cast<Index>(mesh.triangles.size());
  Components components;
  if (options.gocad_full) {
    components = connectedComponents(mesh, options.threads);
    faces.resize(std::max<std::size_t>(components.triangle_count.size(), 1));
  }
  for (Index v = 0; v < vertices; ++v)
    faces[options.gocad_full ? static_cast<std::size_t>(std::max<Index>(components.of_vertex[static_cast<std::size_t>(v)], 0)) : 0].vertices.push_back(v);
  for (Index t = 0; t < triangles; ++t)
    faces[options.gocad_full ? static_cast<std::size_t>(components.of_triangle[static_cast<std::size_t>(t)]) : 0].triangles.push_back(t);
  return faces;
}

/// A border stone and the start of each loop of border edges; ids of borders follow those of the vertices.
std::string bordersOf(const TriangleMesh& mesh, const std::vector<std::int64_t>& id_of) {
  const EdgeAdjacency adjacency(mesh);
  std::vector<Index> next(mesh.vertices.size(), -1);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t e = 0; e < 3; ++e)
      if (adjacency.isBorder(static_cast<Index>(3 * t + e)))
        next[static_cast<std::size_t>(mesh.triangles[t][e])] = mesh.triangles[t][(e + 1) % 3];
  std::string stones;
  std::string borders;
  auto id = static_cast<std::int64_t>(mesh.vertices.size());
  for (std::size_t first = 0; first < next.size(); ++first) {
    if (next[first] < 0)
      continue;
    const std::string start = std::to_string(id_of[first]);
    stones += "BSTONE " + start + "\n";
    borders += "BORDER " + std::to_string(++id) + " " + start + " " + std::to_string(id_of[static_cast<std::size_t>(next[first])]) + "\n";
    for (auto v = static_cast<Index>(first); v >= 0;)
      v = std::exchange(next[static_cast<std::size_t>(v)], -1);
  }
  return stones + borders;
}

} // namespace

std::string gocadHeader(const std::string& type, const std::string& name, const GocadFrame& frame) {
  const std::string& xy = frame.xy_unit;
  return "GOCAD " + type + " 1\nHEADER {\nname:" + oneLine(name) +
         "\n}\nGOCAD_ORIGINAL_COORDINATE_SYSTEM\nNAME Default\nAXIS_NAME \"X\" \"Y\" \"Z\"\nAXIS_UNIT \"" + xy + "\" \"" + xy + "\" \"" +
         frame.z_unit + "\"\nZPOSITIVE " + (frame.z_positive == ZPositive::Down ? "Depth" : "Elevation") + "\nEND_ORIGINAL_COORDINATE_SYSTEM\n";
}

void writeGocadMesh(const std::string& path, const TriangleMesh& mesh,
                    const MeshWriteOptions& options) {
  const std::string properties = options.gocad_properties || options.gocad_full ? propertiesOf(mesh) : "";
  AtomicFile file(path);
  file.write(gocadHeader("TSurf", options.name, {options.z_positive, options.xy_unit, options.z_unit}) + properties);
  const std::vector<Face> faces = facesOf(mesh, options);
  std::vector<std::int64_t> id_of(mesh.vertices.size());
  std::int64_t id = 0;
  for (const Face& face : faces) {
    for (const Index v : face.vertices)
      id_of[static_cast<std::size_t>(v)] = ++id;
    file.write("TFACE\n");
    writeRows(file, face.vertices.size(), options.threads, [&](std::size_t begin, std::size_t end, std::string& text) {
      for (std::size_t i = begin; i < end; ++i) {
        const auto v = static_cast<std::size_t>(face.vertices[i]);
        text += properties.empty() ? "VRTX " : "PVRTX ";
        appendNumber(text, id_of[v]);
        for (const double coordinate : mesh.vertices[v]) {
          text += ' ';
          appendNumber(text, coordinate);
        }
        if (!properties.empty())
          appendProperties(mesh, v, text);
        text += " CNXYZ\n";
      }
    });
    writeRows(file, face.triangles.size(), options.threads, [&](std::size_t begin, std::size_t end, std::string& text) {
      for (std::size_t i = begin; i < end; ++i) {
        text += "TRGL";
        for (const Index v : mesh.triangles[static_cast<std::size_t>(face.triangles[i])]) {
          text += ' ';
          appendNumber(text, id_of[static_cast<std::size_t>(v)]);
        }
        text += '\n';
      }
    });
  }
  if (options.gocad_full)
    file.write(bordersOf(mesh, id_of));
  file.write("END\n");
  file.commit();
}

} // namespace graben
