#pragma once

#include "graben/io/mesh_reader.h"
#include "graben/io/mesh_writer.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace graben {

/// One reader per format; \a bytes is the whole file, \a path is for messages and default names.
std::vector<MeshInput> readGocadMeshes(std::string_view text, const std::string& path);
MeshInput readPlyMesh(std::string_view bytes, const std::string& path);
MeshInput readObjMesh(std::string_view text, const std::string& path);
MeshInput readStlMesh(std::string_view bytes, const std::string& path);
MeshInput readVtkMesh(std::string_view bytes, const std::string& path);
MeshInput readVtkXmlMesh(std::string_view bytes, const std::string& path);

/// As readMeshes, also files whose points no triangle joins.
std::vector<MeshInput> readMeshesOrPoints(const std::string& path);

/// One writer per format; the mesh is valid.
void writePlyMesh(const std::string& path, const TriangleMesh& mesh,
                  const MeshWriteOptions& options);
void writeObjMesh(const std::string& path, const TriangleMesh& mesh,
                  const MeshWriteOptions& options);
void writeStlMesh(const std::string& path, const TriangleMesh& mesh,
                  const MeshWriteOptions& options);
void writeGocadMesh(const std::string& path, const TriangleMesh& mesh,
                    const MeshWriteOptions& options);
void writeVtkMesh(const std::string& path, const TriangleMesh& mesh,
                  const MeshWriteOptions& options);
void writeVtpMesh(const std::string& path, const TriangleMesh& mesh,
                  const MeshWriteOptions& options);

/// A scalar that is a flag: 1 where it is true.
inline std::uint8_t flagOf(float value) {
  return value > 0.5F ? 1 : 0;
}

} // namespace graben
