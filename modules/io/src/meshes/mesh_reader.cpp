#include "graben/io/mesh_reader.h"

#include "content/file_content.h"
#include "meshes/mesh_formats.h"
#include "picks/file_format.h"

#include "graben/core/errors.h"

#include <algorithm>

namespace graben {
namespace {

MeshInput readOne(FileFormat format, const FileContent& content, const std::string& path) {
  std::string storage;
  switch (format) {
  case FileFormat::Ply:
    return readPlyMesh(content.bytes(), path);
  case FileFormat::Obj:
    return readObjMesh(textOf(content, path, storage), path);
  case FileFormat::Stl:
    return readStlMesh(content.bytes(), path);
  case FileFormat::VtkLegacy:
    return readVtkMesh(content.bytes(), path);
  case FileFormat::VtkXml:
    return readVtkXmlMesh(content.bytes(), path);
  default:
    throw ParseError(
        path, 0, "is " + describe(format) + ", not a triangle mesh (.ply .vtk .vtp .obj .stl .ts)");
  }
}

/// Each part of a GOCAD file as its own piece.
void labelParts(std::vector<MeshInput>& meshes) {
  Index next = 0;
  for (MeshInput& input : meshes) {
    std::vector<Index>& piece = input.mesh.piece;
    piece.resize(input.mesh.vertices.size(), 0);
    Index last = 0;
    for (Index& p : piece) {
      last = std::max(last, p);
      p += next;
    }
    next += last + 1;
  }
}

/// Vertices that are not finite go, with the triangles on them.
void dropNotFinite(MeshInput& input) {
  TriangleMesh& mesh = input.mesh;
  const auto finite = [&](Index v) {
    return mesh.vertices[static_cast<std::size_t>(v)].allFinite();
  };
  const auto all_finite = [](const Vector3& p) { return p.allFinite(); };
  if (std::all_of(mesh.vertices.begin(), mesh.vertices.end(), all_finite))
    return;
  const auto end =
      std::remove_if(mesh.triangles.begin(), mesh.triangles.end(), [&](const Triangle& t) {
        return !finite(t[0]) || !finite(t[1]) || !finite(t[2]);
      });
  input.notes.push_back(std::to_string(mesh.triangles.end() - end) +
                        " triangles with a corner that is not finite dropped");
  mesh.triangles.erase(end, mesh.triangles.end());
  if (mesh.triangles.empty())
    mesh.vertices.erase(std::remove_if(mesh.vertices.begin(), mesh.vertices.end(), [&](const Vector3& p) { return !all_finite(p); }), mesh.vertices.end());
  else
    removeUnreferencedVertices(mesh);
}

} // namespace

std::vector<MeshInput> readMeshesOrPoints(const std::string& path) {
  const FileContent content(path);
  if (content.bytes().empty())
    throw ParseError(path, 0, "the file is empty");
  const FileFormat format = formatOf(content.bytes(), path);
  std::string storage;
  std::vector<MeshInput> meshes;
  if (format == FileFormat::Gocad)
    meshes = readGocadMeshes(textOf(content, path, storage), path);
  else
    meshes.push_back(readOne(format, content, path));
  for (MeshInput& input : meshes)
    dropNotFinite(input);
  return meshes;
}

std::vector<MeshInput> readMeshes(const std::string& path) {
  std::vector<MeshInput> meshes = readMeshesOrPoints(path);
  for (const MeshInput& input : meshes)
    if (input.mesh.empty())
      throw ParseError(path, 0, "holds no triangle");
  return meshes;
}

TriangleMesh readMesh(const std::string& path, std::vector<std::string>* warnings) {
  std::vector<MeshInput> meshes = readMeshes(path);
  for (std::size_t i = 0; warnings != nullptr && i < meshes.size(); ++i)
    warnings->insert(warnings->end(), meshes[i].warnings.begin(), meshes[i].warnings.end());
  if (meshes.size() > 1)
    labelParts(meshes);
  TriangleMesh whole = std::move(meshes.front().mesh);
  for (std::size_t i = 1; i < meshes.size(); ++i)
    append(whole, meshes[i].mesh);
  return whole;
}

} // namespace graben
