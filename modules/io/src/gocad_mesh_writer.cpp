// GOCAD TSurf in the plain form that strict readers take: bare header, ids from 1, VRTX lines with
// CNXYZ, one TFACE. Properties (PVRTX) are what they do not take, so only on demand.
#include "mesh_formats.h"
#include "numbers.h"
#include "row_writer.h"

#include "graben/io/atomic_file.h"

#include <algorithm>
#include <array>
#include <cmath>

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

std::string headerOf(const MeshWriteOptions& options, const std::string& properties) {
  const std::string& xy = options.xy_unit;
  return "GOCAD TSurf 1\nHEADER {\nname:" + oneLine(options.name) +
         "\n}\nGOCAD_ORIGINAL_COORDINATE_SYSTEM\nNAME Default\nAXIS_NAME \"X\" \"Y\" "
         "\"Z\"\nAXIS_UNIT \"" +
         xy + "\" \"" + xy + "\" \"" + options.z_unit + "\"\nZPOSITIVE " +
         (options.z_positive == ZPositive::Down ? "Depth" : "Elevation") +
         "\nEND_ORIGINAL_COORDINATE_SYSTEM\n" + properties + "TFACE\n";
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

} // namespace

void writeGocadMesh(const std::string& path, const TriangleMesh& mesh,
                    const MeshWriteOptions& options) {
  const std::string properties = options.gocad_properties ? propertiesOf(mesh) : "";
  AtomicFile file(path);
  file.write(headerOf(options, properties));
  writeRows(file, mesh.vertices.size(), options.threads, [&](std::size_t begin, std::size_t end, std::string& text) {
    for (std::size_t v = begin; v < end; ++v) {
      text += properties.empty() ? "VRTX " : "PVRTX ";
      appendNumber(text, static_cast<std::int64_t>(v) + 1);
      for (const double coordinate : mesh.vertices[v]) {
        text += ' ';
        appendNumber(text, coordinate);
      }
      if (!properties.empty())
        appendProperties(mesh, v, text);
      text += " CNXYZ\n";
    }
  });
  writeRows(file, mesh.triangles.size(), options.threads, [&](std::size_t begin, std::size_t end, std::string& text) {
    for (std::size_t t = begin; t < end; ++t) {
      text += "TRGL";
      for (const Index v : mesh.triangles[t]) {
        text += ' ';
        appendNumber(text, std::int64_t{v} + 1);
      }
      text += '\n';
    }
  });
  file.write("END\n");
  file.commit();
}

} // namespace graben
