#include "graben/core/errors.h"
#include "graben/io/mesh_writer.h"
#include "graben/io/pick_writer.h"
#include "support/temp_folder.h"

#include <gtest/gtest.h>

namespace graben {
namespace {

using test::TempFolder;

TEST(Writers, reportAFullDisk) {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  const TempFolder folder;
  for (const std::string& extension : meshWriteExtensions()) {
    const std::string path = folder.path("full" + extension);
    std::filesystem::create_symlink("/dev/full", path);
    EXPECT_THROW(writeMesh(path, mesh), WriteError) << extension;
    EXPECT_THROW(writeMesh("/nowhere/a" + extension, mesh), WriteError) << extension;
  }
  EXPECT_THROW(writeXyz("/dev/full", mesh.vertices), WriteError);
  EXPECT_THROW(writePcd("/dev/full", {mesh.vertices, {}, {}}), WriteError);
}

} // namespace
} // namespace graben
