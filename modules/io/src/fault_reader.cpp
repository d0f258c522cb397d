#include "graben/io/fault_reader.h"

#include "fault_formats.h"
#include "file_content.h"
#include "file_format.h"
#include "mesh_formats.h"

#include "graben/core/errors.h"

namespace graben {
namespace {

std::vector<FaultInput> faultsFromMeshes(std::vector<MeshInput> meshes, const std::string& path) {
  std::vector<FaultInput> faults;
  for (MeshInput& m : meshes)
    faults.push_back(
        {std::move(m.name), std::move(m.mesh), m.z_positive, path, std::move(m.notes), std::move(m.warnings)});
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
    throw ParseError(path, 0, "is a PCD point cloud, not a fault (a surface or sticks)");
  default:
    return faultsFromMeshes(readMeshes(path), path);
  }
}

} // namespace graben
