#include "mesh_formats.h"
#include "numbers.h"

#include "graben/io/atomic_file.h"

#include <array>
#include <set>

namespace graben {
namespace {

/// Property names are single words and must not repeat.
std::string propertyName(std::string_view name, const std::set<std::string>& taken) {
  std::string word;
  for (const char c : name)
    word += static_cast<unsigned char>(c) > ' ' && c != 0x7F ? c : '_';
  if (word.empty() || taken.count(word) > 0)
    word = "scalar_" + word;
  while (taken.count(word) > 0)
    word += '_';
  return word;
}

std::string headerOf(const TriangleMesh& mesh) {
  std::string header = "ply\nformat binary_little_endian 1.0\nelement vertex ";
  appendNumber(header, static_cast<std::int64_t>(mesh.vertices.size()));
  std::set<std::string> taken = {"x", "y", "z", "nx", "ny", "nz", "piece"};
  header += "\nproperty double x\nproperty double y\nproperty double z\n";
  if (!mesh.normals.empty())
    header += "property float nx\nproperty float ny\nproperty float nz\n";
  if (!mesh.piece.empty())
    header += "property int piece\n";
  for (const auto& scalar : mesh.scalars) {
    const std::string name = propertyName(scalar.first, taken);
    taken.insert(name);
    header += "property float " + name + "\n";
  }
  header += "element face ";
  appendNumber(header, static_cast<std::int64_t>(mesh.triangles.size()));
  return header + "\nproperty list uchar int vertex_indices\nend_header\n";
}

} // namespace

void writePlyMesh(const std::string& path, const TriangleMesh& mesh) {
  AtomicFile file(path);
  file.write(headerOf(mesh));
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    file.writeRaw(
        std::array<double, 3>{mesh.vertices[i].x(), mesh.vertices[i].y(), mesh.vertices[i].z()});
    if (!mesh.normals.empty()) {
      const Eigen::Vector3f normal = mesh.normals[i].cast<float>();
      file.writeRaw(std::array<float, 3>{normal.x(), normal.y(), normal.z()});
    }
    if (!mesh.piece.empty())
      file.writeRaw(mesh.piece[i]);
    for (const auto& scalar : mesh.scalars)
      file.writeRaw(scalar.second[i]);
  }
  for (const Triangle& triangle : mesh.triangles) {
    file.write("\3");
    file.writeRaw(triangle);
  }
  file.commit();
}

} // namespace graben
