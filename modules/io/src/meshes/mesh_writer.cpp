#include "graben/io/mesh_writer.h"

#include "content/file_content.h"
#include "meshes/mesh_formats.h"

#include "graben/core/errors.h"
#include "graben/io/extension.h"
#include "graben/mesh/bounds.h"

#include <algorithm>
#include <cmath>

namespace graben {
namespace {

std::string formatList() {
  std::string list;
  for (const std::string& extension : meshWriteExtensions())
    list += (list.empty() ? "" : " ") + extension;
  return list;
}

/// The distance between neighbouring float32 numbers at the mesh's largest coordinate.
double floatStep(const TriangleMesh& mesh) {
  double largest = 0.0;
  for (const Vector3& v : mesh.vertices)
    largest = std::max(largest, v.cwiseAbs().maxCoeff());
  return std::ldexp(1.0, std::ilogb(std::max(largest, 1e-30)) - 23);
}

std::vector<std::string> lossNotes(const std::string& extension, const TriangleMesh& mesh, const MeshWriteOptions& options) {
  std::vector<std::string> notes;
  const std::string place = extension + " files ";
  const bool stl = extension == ".stl";
  const bool plain_gocad = extension == ".ts" && !options.gocad_properties && !options.gocad_full;
  const std::string none = plain_gocad ? "for strict readers hold no properties, so not" : "have no place for";
  if (stl && floatStep(mesh) > 1e-3)
    notes.push_back(place + "hold float32: coordinates were rounded to steps of up to " +
                    std::to_string(floatStep(mesh)));
  if (!mesh.piece.empty() && (stl || plain_gocad))
    notes.push_back(place + none + " the piece label");
  if (!mesh.normals.empty() && (stl || extension == ".ts"))
    notes.push_back(place + "have no place for vertex normals");
  if (!mesh.scalars.empty() && (stl || plain_gocad || extension == ".obj"))
    notes.push_back(place + none + " vertex scalars");
  return notes;
}

} // namespace

const std::vector<std::string>& meshWriteExtensions() {
  static const std::vector<std::string> extensions = {".ply", ".vtk", ".vtp",
                                                      ".obj", ".stl", ".ts"};
  return extensions;
}

Vector3 originFor(const Points& points) {
  const Bounds box = boundsOf(points);
  return box.empty() ? Vector3(Vector3::Zero()) : Vector3((0.5 * (box.low + box.high)).array().round());
}

void writePlyPoints(const std::string& path, const Points& points, const Points& normals, const MeshWriteOptions& options) {
  TriangleMesh cloud;
  cloud.vertices = points;
  cloud.normals = normals;
  if (!normals.empty() && normals.size() != points.size())
    throw InvalidInputError("writing " + path, "normals are not as many as the points");
  writePlyMesh(path, cloud, options);
}

std::vector<std::string> writeMesh(const std::string& path, const TriangleMesh& mesh,
                                   const MeshWriteOptions& options) {
  const std::string extension = extensionOf(path);
  const auto& known = meshWriteExtensions();
  if (std::find(known.begin(), known.end(), extension) == known.end())
    throw InvalidInputError("writing " + path, "the format '" + extension +
                                                   "' is not known; use one of " + formatList());
  validate(mesh, "writing " + path);
  if (extension == ".ply")
    writePlyMesh(path, mesh, options);
  else if (extension == ".vtk")
    writeVtkMesh(path, mesh, options);
  else if (extension == ".vtp")
    writeVtpMesh(path, mesh, options);
  else if (extension == ".obj")
    writeObjMesh(path, mesh, options);
  else if (extension == ".stl")
    writeStlMesh(path, mesh, options);
  else
    writeGocadMesh(path, mesh, options);
  return lossNotes(extension, mesh, options);
}

} // namespace graben
