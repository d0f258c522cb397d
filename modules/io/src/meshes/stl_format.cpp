#include "content/file_content.h"
#include "content/line_reader.h"
#include "content/numbers.h"
#include "content/row_writer.h"
#include "meshes/mesh_formats.h"

#include "graben/core/atomic_file.h"
#include "graben/core/errors.h"

#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <unordered_map>

namespace graben {
namespace {

struct BitwiseHash {
  std::size_t operator()(const std::array<double, 3>& p) const {
    std::size_t hash = 0;
    for (const double c : p)
      hash = hash * 0x9E3779B97F4A7C15ULL + (std::hash<double>()(c) ^ (hash >> 29));
    return hash;
  }
};

/// Builds a mesh from loose corners: equal corners become one vertex.
class CornerJoiner {
public:
  Index add(const Vector3& p) {
    const std::array<double, 3> key = {p.x() + 0.0, p.y() + 0.0, p.z() + 0.0};
    const auto found = index_.emplace(key, static_cast<Index>(vertices_.size()));
    if (found.second)
      vertices_.push_back(p);
    return found.first->second;
  }
  Points take() { return std::move(vertices_); }

private:
  std::unordered_map<std::array<double, 3>, Index, BitwiseHash> index_;
  Points vertices_;
};

bool isBinary(std::string_view bytes) {
  std::uint32_t count = 0;
  if (bytes.size() < 84)
    return false;
  std::memcpy(&count, bytes.data() + 80, sizeof(count));
  return bytes.size() == 84 + std::uint64_t{50} * count || toLower(bytes.substr(0, 5)) != "solid";
}

TriangleMesh readBinaryStl(std::string_view bytes, const std::string& path) {
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + 80, sizeof(count));
  if (bytes.size() < 84 + std::uint64_t{50} * count)
    throw ParseError(path, 0,
                     "is no STL mesh, or cut short: its header promises " + std::to_string(count) +
                         " triangles, it holds " + std::to_string((bytes.size() - 84) / 50));
  CornerJoiner joiner;
  TriangleMesh mesh;
  mesh.triangles.resize(count);
  for (std::size_t t = 0; t < count; ++t) {
    std::array<float, 12> values; // normal, three corners
    std::memcpy(values.data(), bytes.data() + 84 + 50 * t, sizeof(values));
    for (std::size_t c = 0; c < 3; ++c) {
      const Vector3 corner(values[3 * c + 3], values[3 * c + 4], values[3 * c + 5]);
      if (!corner.allFinite())
        throw ParseError(path, 0,
                         "triangle " + std::to_string(t) + " has a corner that is not finite");
      mesh.triangles[t][c] = joiner.add(corner);
    }
  }
  mesh.vertices = joiner.take();
  return mesh;
}

TriangleMesh readTextStl(std::string_view text, const std::string& path, bool& ended) {
  LineReader reader(text);
  std::string_view line;
  std::vector<std::string_view> words;
  std::vector<Index> loop;
  CornerJoiner joiner;
  TriangleMesh mesh;
  while (reader.next(line)) {
    splitWords(line, words);
    const std::string key = words.empty() ? std::string() : toLower(words[0]);
    ended |= key == "endsolid" || key == "end";
    if (key == "vertex") {
      Vector3 corner;
      for (std::size_t k = 0; k < 3; ++k)
        if (k + 1 >= words.size() ||
            !parseField(words[k + 1], corner[static_cast<Eigen::Index>(k)]) ||
            !std::isfinite(corner[static_cast<Eigen::Index>(k)]))
          throw ParseError(path, reader.number(), "a vertex needs three finite numbers");
      loop.push_back(joiner.add(corner));
    } else if (key == "endloop") {
      if (loop.size() != 3)
        throw ParseError(path, reader.number(), "a facet must have three vertices");
      mesh.triangles.push_back({loop[0], loop[1], loop[2]});
      loop.clear();
    }
  }
  if (!loop.empty())
    throw ParseError(path, reader.number(), "the file is cut short");
  mesh.vertices = joiner.take();
  return mesh;
}

} // namespace

MeshInput readStlMesh(std::string_view bytes, const std::string& path) {
  MeshInput input;
  input.name = stemOf(path);
  bool ended = isBinary(bytes);
  input.mesh = ended ? readBinaryStl(bytes, path) : readTextStl(bytes, path, ended);
  if (!ended)
    input.warnings.push_back(path + ": the solid has no endsolid; the file may be cut short");
  return input;
}

void writeStlMesh(const std::string& path, const TriangleMesh& mesh,
                  const MeshWriteOptions& options) {
  AtomicFile file(path);
  // Readers take a header that starts with "solid" for a text file.
  std::string header = "binary STL: " + options.name;
  header.resize(80, ' ');
  file.write(header);
  file.writeRaw(static_cast<std::uint32_t>(mesh.triangles.size()));
  constexpr std::size_t facet_size = 12 * sizeof(float) + sizeof(std::uint16_t);
  writeRows(file, mesh.triangles.size(), options.threads, [&](std::size_t begin, std::size_t end, std::string& bytes) {
    ByteFiller filler(bytes, (end - begin) * facet_size);
    for (std::size_t i = begin; i < end; ++i) {
      const Triangle& t = mesh.triangles[i];
      const Vector3& a = mesh.vertices[static_cast<std::size_t>(t[0])];
      const Vector3& b = mesh.vertices[static_cast<std::size_t>(t[1])];
      const Vector3& c = mesh.vertices[static_cast<std::size_t>(t[2])];
      for (const Vector3& v : {Vector3((b - a).cross(c - a).stableNormalized()), a, b, c})
        filler.putVector<float>(v);
      filler.put(std::uint16_t{0});
    }
  });
  file.commit();
}

} // namespace graben
