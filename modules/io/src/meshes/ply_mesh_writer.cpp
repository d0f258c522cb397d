#include "content/numbers.h"
#include "content/row_writer.h"
#include "meshes/mesh_formats.h"

#include "graben/core/atomic_file.h"

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

std::string headerOf(const TriangleMesh& mesh, const MeshWriteOptions& options) {
  std::string header = "ply\nformat binary_little_endian 1.0\n";
  if (options.origin) {
    header += "comment origin";
    for (const double coordinate : *options.origin) {
      header += ' ';
      appendNumber(header, coordinate);
    }
    header += '\n';
  }
  header += "element vertex ";
  appendNumber(header, static_cast<std::int64_t>(mesh.vertices.size()));
  std::set<std::string> taken = {"x", "y", "z", "nx", "ny", "nz", "piece"};
  header += options.origin ? "\nproperty float x\nproperty float y\nproperty float z\n" : "\nproperty double x\nproperty double y\nproperty double z\n";
  if (!mesh.normals.empty())
    header += "property float nx\nproperty float ny\nproperty float nz\n";
  if (!mesh.piece.empty())
    header += "property int piece\n";
  for (const auto& scalar : mesh.scalars) {
    const std::string name = propertyName(scalar.first, taken);
    taken.insert(name);
    header += (options.flags.count(scalar.first) > 0 ? "property uchar " : "property float ") + name + "\n";
  }
  header += "element face ";
  appendNumber(header, static_cast<std::int64_t>(mesh.triangles.size()));
  return header + "\nproperty list uchar int vertex_indices\nend_header\n";
}

/// A scalar of the mesh as it is written.
struct Scalar {
  const float* values;
  bool flag;
};

std::vector<Scalar> scalarsOf(const TriangleMesh& mesh, const MeshWriteOptions& options) {
  std::vector<Scalar> scalars;
  for (const auto& [name, values] : mesh.scalars)
    scalars.push_back({values.data(), options.flags.count(name) > 0});
  return scalars;
}

void writeVertices(AtomicFile& file, const TriangleMesh& mesh, const MeshWriteOptions& options) {
  const std::vector<Scalar> scalars = scalarsOf(mesh, options);
  std::size_t size = 3 * (options.origin ? sizeof(float) : sizeof(double)) +
                     (mesh.normals.empty() ? 0 : 3 * sizeof(float)) + (mesh.piece.empty() ? 0 : sizeof(Index));
  for (const Scalar& scalar : scalars)
    size += scalar.flag ? 1 : sizeof(float);
  writeRows(file, mesh.vertices.size(), options.threads, [&](std::size_t begin, std::size_t end, std::string& bytes) {
    ByteFiller filler(bytes, (end - begin) * size);
    for (std::size_t v = begin; v < end; ++v) {
      if (options.origin)
        filler.putVector<float>(mesh.vertices[v] - *options.origin);
      else
        filler.putVector<double>(mesh.vertices[v]);
      if (!mesh.normals.empty())
        filler.putVector<float>(mesh.normals[v]);
      if (!mesh.piece.empty())
        filler.put(mesh.piece[v]);
      for (const Scalar& scalar : scalars) {
        if (scalar.flag)
          filler.put(flagOf(scalar.values[v]));
        else
          filler.put(scalar.values[v]);
      }
    }
  });
}

} // namespace

void writePlyMesh(const std::string& path, const TriangleMesh& mesh, const MeshWriteOptions& options) {
  AtomicFile file(path);
  file.write(headerOf(mesh, options));
  writeVertices(file, mesh, options);
  writeRows(file, mesh.triangles.size(), options.threads, [&](std::size_t begin, std::size_t end, std::string& bytes) {
    ByteFiller filler(bytes, (end - begin) * (1 + 3 * sizeof(Index)));
    for (std::size_t t = begin; t < end; ++t) {
      filler.put(char{3});
      filler.put(mesh.triangles[t]);
    }
  });
  file.commit();
}

} // namespace graben
