#include "content/numbers.h"

#include "graben/core/errors.h"
#include "graben/core/atomic_file.h"
#include "graben/io/sealed_writer.h"

#include <algorithm>
#include <filesystem>
#include <set>

namespace graben {

namespace {

namespace fs = std::filesystem;

/// Names in a Model3d end at blanks.
std::string word(std::string name) {
  std::replace_if(name.begin(), name.end(), [](unsigned char c) { return c <= ' ' || c == '"'; }, '_');
  return name;
}

std::string fileName(std::string name) {
  std::replace_if(name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0 && c != '-' && c != '_' && c != '.' && c != '+'; }, '_');
  return name;
}

std::string attribute(const std::string& text) {
  std::string escaped;
  for (const char c : text)
    escaped += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '"' ? "&quot;" : std::string(1, c);
  return "\"" + escaped + "\"";
}

void appendRow(std::string& text, const std::string& start, const Vector3& p) {
  text += start;
  for (const double x : p) {
    text += ' ';
    appendNumber(text, x);
  }
  text += '\n';
}

class Model3d {
public:
  Model3d(const SealedMesh& mesh, const MeshWriteOptions& options) : mesh_(mesh), options_(options), triangles_(mesh.patches.size()) {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      triangles_[static_cast<std::size_t>(mesh.triangle_patch[t])].push_back(t);
    for (std::size_t s = 0; s < mesh.surfaces.size(); ++s)
      for (std::size_t p = 0; p < mesh.patches.size(); ++p)
        if (mesh.patches[p].surface == static_cast<Index>(s))
          order_.push_back(p);
  }

  void write(const std::string& path) const {
    AtomicFile file(path);
    std::string text = "GOCAD Model3d 1\nHEADER {\nname:" + word(options_.name) + "\n}\n" + coordinateSystem();
    std::set<Index> used;
    for (const std::size_t p : order_)
      if (used.insert(mesh_.patches[p].surface).second)
        text += "TSURF " + surfaceName(mesh_.patches[p].surface) + "\n";
    for (std::size_t i = 0; i < order_.size(); ++i)
      text += face(i);
    text += regions();
    file.write(text + "END\n");
    std::size_t vertex = 1;
    for (std::size_t i = 0; i < order_.size();) {
      const Index surface = mesh_.patches[order_[i]].surface;
      text = "GOCAD TSurf 1\nHEADER {\nname:" + surfaceName(surface) + "\n}\n" + coordinateSystem() + "GEOLOGICAL_TYPE " + type(surface) +
             "\nGEOLOGICAL_FEATURE " + surfaceName(surface) + "\n";
      vertex = 1;
      for (; i < order_.size() && mesh_.patches[order_[i]].surface == surface; ++i)
        appendPatch(text, order_[i], vertex);
      file.write(text + "END\n");
    }
    file.commit();
  }

private:
  std::string surfaceName(Index surface) const { return word(mesh_.surfaces[static_cast<std::size_t>(surface)].name); }

  std::string coordinateSystem() const {
    return "GOCAD_ORIGINAL_COORDINATE_SYSTEM\nNAME Default\nAXIS_NAME \"X\" \"Y\" \"Z\"\nAXIS_UNIT \"" + options_.xy_unit + "\" \"" + options_.xy_unit +
           "\" \"" + options_.z_unit + "\"\nZPOSITIVE " + (options_.z_positive == ZPositive::Down ? "Depth" : "Elevation") +
           "\nEND_ORIGINAL_COORDINATE_SYSTEM\n";
  }

  const char* type(Index surface) const {
    switch (mesh_.surfaces[static_cast<std::size_t>(surface)].kind) {
    case SealedSurfaceKind::Horizon:
      return "top";
    case SealedSurfaceKind::Fault:
      return "fault";
    case SealedSurfaceKind::Wall:
    case SealedSurfaceKind::Top:
    case SealedSurfaceKind::Base:
      break;
    }
    return "boundary";
  }

  std::string face(std::size_t place) const {
    const std::size_t p = order_[place];
    const Triangle& t = mesh_.triangles[triangles_[p].front()];
    std::string text = "TFACE " + std::to_string(place + 1) + " " + type(mesh_.patches[p].surface) + " " + surfaceName(mesh_.patches[p].surface) + "\n";
    for (const Index v : t)
      appendRow(text, " ", mesh_.vertices[static_cast<std::size_t>(v)]);
    return text;
  }

  /// The faces round a region, eight to a line and ended by 0; + for the side that the face's normal points to.
  std::string faceList(const std::vector<std::string>& faces) const {
    std::string text;
    for (std::size_t i = 0; i <= faces.size(); ++i) {
      text += " " + (i < faces.size() ? faces[i] : std::string("0"));
      text += i % 8 == 7 || i == faces.size() ? "\n" : "";
    }
    return text;
  }

  std::string regions() const {
    std::vector<std::string> outside;
    for (std::size_t i = 0; i < order_.size(); ++i)
      if (mesh_.patches[order_[i]].in_front < 0)
        outside.push_back("+" + std::to_string(i + 1));
    std::string text = "REGION 1 Universe\n" + faceList(outside);
    for (std::size_t b = 0; b < mesh_.blocks.size(); ++b) {
      std::vector<std::string> faces;
      for (std::size_t i = 0; i < order_.size(); ++i) {
        const SealedPatch& patch = mesh_.patches[order_[i]];
        if (patch.behind == static_cast<Index>(b))
          faces.push_back("-" + std::to_string(i + 1));
        if (patch.in_front == static_cast<Index>(b))
          faces.push_back("+" + std::to_string(i + 1));
      }
      text += "REGION " + std::to_string(b + 2) + " " + word(mesh_.blocks[b].name) + "\n" + faceList(faces);
    }
    return text;
  }

  void appendPatch(std::string& text, std::size_t patch, std::size_t& vertex) const {
    text += "TFACE\n";
    std::vector<Index> vertices;
    for (const std::size_t t : triangles_[patch])
      vertices.insert(vertices.end(), mesh_.triangles[t].begin(), mesh_.triangles[t].end());
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    const std::size_t first = vertex;
    for (const Index v : vertices)
      appendRow(text, "VRTX " + std::to_string(vertex++), mesh_.vertices[static_cast<std::size_t>(v)]);
    const auto number = [&](Index v) {
      return std::to_string(first + static_cast<std::size_t>(std::lower_bound(vertices.begin(), vertices.end(), v) - vertices.begin()));
    };
    for (const std::size_t t : triangles_[patch]) {
      const Triangle& v = mesh_.triangles[t];
      text += "TRGL " + number(v[0]) + " " + number(v[1]) + " " + number(v[2]) + "\n";
    }
  }

  const SealedMesh& mesh_;
  const MeshWriteOptions& options_;
  std::vector<std::vector<std::size_t>> triangles_; ///< of each patch
  std::vector<std::size_t> order_;                  ///< patches, surface by surface
};

} // namespace

void writeModel3d(const std::string& path, const SealedMesh& mesh, const MeshWriteOptions& options) { Model3d(mesh, options).write(path); }

void writeMultiblock(const std::string& path, const SealedMesh& mesh) {
  const fs::path file = path;
  const fs::path folder = file.parent_path() / file.stem();
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    throw IoError(folder.string(), "the folder cannot be made: " + error.message());
  std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"vtkMultiBlockDataSet\" version=\"1.0\" byte_order=\"LittleEndian\">\n  <vtkMultiBlockDataSet>\n";
  const auto group = [&](std::size_t number, const std::string& name) {
    text += "    <Block index=\"" + std::to_string(number) + "\" name=" + attribute(name) + ">\n";
  };
  std::size_t place = 0;
  const auto add = [&](const std::string& prefix, const std::string& name, TriangleMesh part) {
    part.piece.assign(part.vertices.size(), static_cast<Index>(place));
    const std::string part_file = prefix + fileName(name) + ".vtp";
    writeMesh((folder / part_file).string(), part, {});
    text += "      <DataSet index=\"" + std::to_string(place++) + "\" name=" + attribute(name) + " file=" +
            attribute(file.stem().string() + "/" + part_file) + "/>\n";
  };
  group(0, "blocks");
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b)
    add("block_", mesh.blocks[b].name, blockSurface(mesh, static_cast<Index>(b)));
  text += "    </Block>\n";
  place = 0;
  group(1, "surfaces");
  for (std::size_t s = 0; s < mesh.surfaces.size(); ++s) {
    TriangleMesh part = patchesOf(mesh, static_cast<Index>(s));
    if (!part.empty())
      add("surface_", mesh.surfaces[s].name, std::move(part));
  }
  writeFile(path, text + "    </Block>\n  </vtkMultiBlockDataSet>\n</VTKFile>\n");
}

} // namespace graben
