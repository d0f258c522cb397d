#include "content/numbers.h"

#include "graben/core/atomic_file.h"
#include "graben/io/sealed_writer.h"

#include <algorithm>
#include <map>
#include <set>

namespace graben {

namespace {

std::string quoted(const std::string& name) {
  std::string text = name;
  std::replace_if(text.begin(), text.end(), [](char c) { return c == '"' || c == '\n' || c == '\r'; }, '_');
  return "\"" + text + "\"";
}

std::string groupName(const SealedSurface& surface) {
  switch (surface.kind) {
  case SealedSurfaceKind::Horizon:
    return "horizon " + surface.name;
  case SealedSurfaceKind::Fault:
    return "fault " + surface.name;
  case SealedSurfaceKind::Top:
  case SealedSurfaceKind::Base:
  case SealedSurfaceKind::Wall:
    break;
  }
  return "wall " + surface.name;
}

/// gmsh's entities: points, curves and surfaces count from 1.
class GmshWriter {
public:
  explicit GmshWriter(const SealedMesh& mesh) : mesh_(mesh), lines_(sealedLines(mesh)) {
    findPoints();
    findBoundaries();
  }

  void write(const std::string& path) const {
    AtomicFile file(path);
    file.write("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n");
    writeNames(file);
    writeEntities(file);
    writeNodes(file);
    writeElements(file);
    file.commit();
  }

  void writeVolumes(const std::string& path, const std::string& mesh_name) const {
    AtomicFile file(path);
    file.write("// The blocks as volumes: gmsh -3 this file\nMerge " + quoted(mesh_name) + ";\n");
    for (std::size_t b = 0; b < mesh_.blocks.size(); ++b)
      file.write(volumeOf(static_cast<Index>(b)));
    file.write("Mesh.Algorithm3D = 10; // HXT\n");
    file.commit();
  }

private:
  void findPoints() {
    std::set<Index> ends;
    for (const std::vector<Index>& line : lines_) {
      ends.insert(line.front());
      ends.insert(line.back());
    }
    for (const Index v : ends)
      points_.emplace(v, static_cast<Index>(points_.size()) + 1);
  }

  /// The lines along each patch.
  void findBoundaries() {
    std::map<std::pair<Index, Index>, Index> line_of;
    for (std::size_t l = 0; l < lines_.size(); ++l)
      line_of[{std::min(lines_[l][0], lines_[l][1]), std::max(lines_[l][0], lines_[l][1])}] = static_cast<Index>(l) + 1;
    bounding_.resize(mesh_.patches.size());
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
      for (std::size_t e = 0; e < 3; ++e) {
        const Index a = mesh_.triangles[t][e], b = mesh_.triangles[t][(e + 1) % 3];
        const auto found = line_of.find({std::min(a, b), std::max(a, b)});
        if (found != line_of.end())
          bounding_[static_cast<std::size_t>(mesh_.triangle_patch[t])].insert(found->second);
      }
  }

  void writeNames(AtomicFile& file) const {
    file.write("$PhysicalNames\n" + std::to_string(mesh_.surfaces.size()) + "\n");
    for (std::size_t s = 0; s < mesh_.surfaces.size(); ++s)
      file.write("2 " + std::to_string(s + 1) + " " + quoted(groupName(mesh_.surfaces[s])) + "\n");
    file.write("$EndPhysicalNames\n");
  }

  void appendPlace(std::string& text, const Vector3& p) const {
    for (const double x : p) {
      appendNumber(text, x);
      text += ' ';
    }
  }

  template <typename Vertices>
  void appendBox(std::string& text, const Vertices& vertices) const {
    Vector3 low = Vector3::Constant(1e300), high = Vector3::Constant(-1e300);
    for (const Index v : vertices) {
      low = low.cwiseMin(mesh_.vertices[static_cast<std::size_t>(v)]);
      high = high.cwiseMax(mesh_.vertices[static_cast<std::size_t>(v)]);
    }
    appendPlace(text, low);
    appendPlace(text, high);
  }

  void writeEntities(AtomicFile& file) const {
    std::string text = "$Entities\n";
    text += std::to_string(points_.size()) + " " + std::to_string(lines_.size()) + " " + std::to_string(mesh_.patches.size()) + " 0\n";
    for (const auto& [vertex, tag] : points_) {
      text += std::to_string(tag) + " ";
      appendPlace(text, mesh_.vertices[static_cast<std::size_t>(vertex)]);
      text += "0\n";
    }
    for (std::size_t l = 0; l < lines_.size(); ++l) {
      text += std::to_string(l + 1) + " ";
      appendBox(text, lines_[l]);
      text += "0 2 " + std::to_string(points_.at(lines_[l].front())) + " " + std::to_string(-points_.at(lines_[l].back())) + "\n";
    }
    std::vector<std::vector<Index>> vertices(mesh_.patches.size());
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
      for (const Index v : mesh_.triangles[t])
        vertices[static_cast<std::size_t>(mesh_.triangle_patch[t])].push_back(v);
    for (std::size_t p = 0; p < mesh_.patches.size(); ++p) {
      text += std::to_string(p + 1) + " ";
      appendBox(text, vertices[p]);
      text += "1 " + std::to_string(mesh_.patches[p].surface + 1) + " " + std::to_string(bounding_[p].size());
      for (const Index line : bounding_[p])
        text += " " + std::to_string(line);
      text += "\n";
    }
    file.write(text + "$EndEntities\n");
  }

  /// Each vertex belongs to the entity of least dimension it lies on.
  void writeNodes(AtomicFile& file) const {
    std::map<std::pair<int, Index>, std::vector<Index>> nodes;
    std::vector<std::uint8_t> taken(mesh_.vertices.size(), 0);
    const auto take = [&](int dimension, Index tag, Index v) {
      if (taken[static_cast<std::size_t>(v)] != 0)
        return;
      taken[static_cast<std::size_t>(v)] = 1;
      nodes[{dimension, tag}].push_back(v);
    };
    for (const auto& [vertex, tag] : points_)
      take(0, tag, vertex);
    for (std::size_t l = 0; l < lines_.size(); ++l)
      for (const Index v : lines_[l])
        take(1, static_cast<Index>(l) + 1, v);
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
      for (const Index v : mesh_.triangles[t])
        take(2, mesh_.triangle_patch[t] + 1, v);
    const std::string count = std::to_string(mesh_.vertices.size());
    file.write("$Nodes\n" + std::to_string(nodes.size()) + " " + count + " 1 " + count + "\n");
    for (const auto& [entity, vertices] : nodes) {
      std::string text = std::to_string(entity.first) + " " + std::to_string(entity.second) + " 0 " + std::to_string(vertices.size()) + "\n";
      for (const Index v : vertices)
        text += std::to_string(v + 1) + "\n";
      for (const Index v : vertices) {
        appendPlace(text, mesh_.vertices[static_cast<std::size_t>(v)]);
        text.back() = '\n';
      }
      file.write(text);
    }
    file.write("$EndNodes\n");
  }

  void writeElements(AtomicFile& file) const {
    std::size_t segments = 0;
    for (const std::vector<Index>& line : lines_)
      segments += line.size() - 1;
    std::vector<std::vector<std::size_t>> triangles(mesh_.patches.size());
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
      triangles[static_cast<std::size_t>(mesh_.triangle_patch[t])].push_back(t);
    const std::string count = std::to_string(points_.size() + segments + mesh_.triangles.size());
    file.write("$Elements\n" + std::to_string(points_.size() + lines_.size() + mesh_.patches.size()) + " " + count + " 1 " + count + "\n");
    std::size_t number = 1;
    std::string text;
    for (const auto& [vertex, tag] : points_)
      text += "0 " + std::to_string(tag) + " 15 1\n" + std::to_string(number++) + " " + std::to_string(vertex + 1) + "\n";
    for (std::size_t l = 0; l < lines_.size(); ++l) {
      text += "1 " + std::to_string(l + 1) + " 1 " + std::to_string(lines_[l].size() - 1) + "\n";
      for (std::size_t i = 0; i + 1 < lines_[l].size(); ++i)
        text += std::to_string(number++) + " " + std::to_string(lines_[l][i] + 1) + " " + std::to_string(lines_[l][i + 1] + 1) + "\n";
    }
    for (std::size_t p = 0; p < mesh_.patches.size(); ++p) {
      text += "2 " + std::to_string(p + 1) + " 2 " + std::to_string(triangles[p].size()) + "\n";
      for (const std::size_t t : triangles[p]) {
        const Triangle& v = mesh_.triangles[t];
        text += std::to_string(number++) + " " + std::to_string(v[0] + 1) + " " + std::to_string(v[1] + 1) + " " + std::to_string(v[2] + 1) + "\n";
      }
      file.write(text);
      text.clear();
    }
    file.write("$EndElements\n");
  }

  std::string volumeOf(Index block) const {
    std::string loop, inside;
    for (std::size_t p = 0; p < mesh_.patches.size(); ++p) {
      const SealedPatch& patch = mesh_.patches[p];
      if (patch.behind == block && patch.in_front == block)
        inside += (inside.empty() ? "" : ", ") + std::to_string(p + 1);
      else if (patch.behind == block || patch.in_front == block)
        loop += (loop.empty() ? "" : ", ") + std::to_string(p + 1);
    }
    const std::string tag = std::to_string(block + 1);
    std::string text = "Surface Loop(" + tag + ") = {" + loop + "};\nVolume(" + tag + ") = {" + tag + "};\n";
    if (!inside.empty())
      text += "Surface{" + inside + "} In Volume{" + tag + "};\n";
    return text + "Physical Volume(" + quoted(mesh_.blocks[static_cast<std::size_t>(block)].name) + ") = {" + tag + "};\n";
  }

  const SealedMesh& mesh_;
  std::vector<std::vector<Index>> lines_;
  std::map<Index, Index> points_;          ///< tag of each vertex where lines end
  std::vector<std::set<Index>> bounding_;  ///< lines of each patch
};

} // namespace

void writeGmsh(const std::string& path, const SealedMesh& mesh) {
  const GmshWriter writer(mesh);
  writer.write(path);
  const auto dot = path.find_last_of('.');
  const auto slash = path.find_last_of('/');
  writer.writeVolumes(path.substr(0, dot) + ".geo", slash == std::string::npos ? path : path.substr(slash + 1));
}

} // namespace graben
