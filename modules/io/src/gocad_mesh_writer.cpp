// GOCAD TSurf in the plain form that strict readers take: bare header, ids from 1, VRTX lines with
// CNXYZ, one TFACE.
#include "mesh_formats.h"
#include "numbers.h"

#include "graben/io/atomic_file.h"

#include <algorithm>

namespace graben {
namespace {

/// Names end at the line's end.
std::string oneLine(std::string name) {
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return name;
}

std::string headerOf(const MeshWriteOptions& options) {
  const std::string& xy = options.xy_unit;
  return "GOCAD TSurf 1\nHEADER {\nname:" + oneLine(options.name) +
         "\n}\nGOCAD_ORIGINAL_COORDINATE_SYSTEM\nNAME Default\nAXIS_NAME \"X\" \"Y\" "
         "\"Z\"\nAXIS_UNIT \"" +
         xy + "\" \"" + xy + "\" \"" + options.z_unit + "\"\nZPOSITIVE " +
         (options.z_positive == ZPositive::Down ? "Depth" : "Elevation") +
         "\nEND_ORIGINAL_COORDINATE_SYSTEM\nTFACE\n";
}

} // namespace

void writeGocadMesh(const std::string& path, const TriangleMesh& mesh,
                    const MeshWriteOptions& options) {
  AtomicFile file(path);
  file.write(headerOf(options));
  std::string line;
  std::int64_t id = 0;
  for (const Vector3& v : mesh.vertices) {
    line = "VRTX ";
    appendNumber(line, ++id);
    for (const double coordinate : v) {
      line += ' ';
      appendNumber(line, coordinate);
    }
    file.write(line += " CNXYZ\n");
  }
  for (const Triangle& t : mesh.triangles) {
    line = "TRGL";
    for (const Index v : t) {
      line += ' ';
      appendNumber(line, std::int64_t{v} + 1);
    }
    file.write(line += '\n');
  }
  file.write("END\n");
  file.commit();
}

} // namespace graben
