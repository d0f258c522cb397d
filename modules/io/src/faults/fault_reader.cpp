#include "graben/io/fault_reader.h"

#include "content/file_content.h"
#include "faults/fault_formats.h"
#include "meshes/mesh_formats.h"
#include "picks/file_format.h"

#include "graben/core/errors.h"
#include "graben/io/pick_reader.h"

namespace graben {
namespace {

/// Says that a fault is points that nothing joins.
void notePoints(FaultInput& fault) {
  const auto& mesh = std::get<TriangleMesh>(fault.geometry);
  if (mesh.vertices.empty())
    throw ParseError(fault.source, 0, "holds neither triangles nor points of a fault");
  if (mesh.triangles.empty())
    fault.notes.push_back(fault.name + " is " + std::to_string(mesh.vertices.size()) + " points of a fault without triangles or sticks");
}

std::vector<FaultInput> faultsFromMeshes(std::vector<MeshInput> meshes, const std::string& path) {
  std::vector<FaultInput> faults;
  for (MeshInput& m : meshes)
    faults.push_back(
        {std::move(m.name), std::move(m.mesh), m.z_positive, path, std::move(m.notes), std::move(m.warnings)});
  for (FaultInput& fault : faults)
    notePoints(fault);
  return faults;
}

std::vector<FaultInput> faultFromPoints(const std::string& path) {
  PickSet points = readPicks(path);
  FaultInput fault{stemOf(path), {}, points.z_positive, path, std::move(points.notes), std::move(points.warnings)};
  TriangleMesh mesh;
  mesh.vertices = std::move(points.points);
  fault.geometry = std::move(mesh);
  notePoints(fault);
  std::vector<FaultInput> faults;
  faults.push_back(std::move(fault));
  return faults;
}

} // namespace

std::vector<FaultInput> readFaults(const std::string& path) {
  const FileContent content(path);
  if (content.bytes().empty())
    throw ParseError(path, 0, "the file is empty");
  std::string storage;
  switch (formatOf(content.bytes(), path)) {
  case FileFormat::Text: {
    const std::string_view text = textOf(content, path, storage);
    return isBln(text) ? readBlnFaults(text, path) : readLineFaults(text, path);
  }
  case FileFormat::Iesx:
    return readIesxFaults(textOf(content, path, storage), path);
  case FileFormat::Charisma:
    return readCharismaFaults(textOf(content, path, storage), path);
  case FileFormat::Cps3:
    return readCps3Faults(textOf(content, path, storage), path);
  case FileFormat::Gocad:
    return readGocadFaults(textOf(content, path, storage), path);
  case FileFormat::Grid:
    throw ParseError(path, 0, "is a grid, not a fault (a surface or sticks)");
  case FileFormat::Pcd:
    return faultFromPoints(path);
  default:
    return faultsFromMeshes(readMeshesOrPoints(path), path);
  }
}

} // namespace graben
