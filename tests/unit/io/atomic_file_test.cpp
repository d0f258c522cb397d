#include "graben/core/errors.h"
#include "graben/io/atomic_file.h"
#include "graben/io/mesh_writer.h"
#include "graben/io/pick_writer.h"
#include "temp_folder.h"

#include <gtest/gtest.h>

namespace graben {
namespace {

using test::contentOf;
using test::TempFolder;

TEST(AtomicFile, appearsOnlyWhenComplete) {
  const TempFolder folder;
  const std::string path = folder.write("out.txt", "former");
  {
    AtomicFile file(path);
    file.write("new");
    EXPECT_EQ(contentOf(path), "former");
    file.commit();
  }
  EXPECT_EQ(contentOf(path), "new");
  EXPECT_EQ(folder.count(), 1U);
}

TEST(AtomicFile, leavesNothingBehindWithoutCommit) {
  const TempFolder folder;
  const std::string path = folder.write("out.txt", "former");
  {
    AtomicFile file(path);
    file.write(std::string(3 << 20, 'x'));
  }
  EXPECT_EQ(contentOf(path), "former");
  EXPECT_EQ(folder.count(), 1U);
}

TEST(AtomicFile, keepsTheOrderOfSmallAndLargePieces) {
  const TempFolder folder;
  const std::string large(3 << 20, 'x');
  AtomicFile file(folder.path("out"));
  file.write("a");
  file.write(large);
  file.write("b");
  file.commit();
  EXPECT_EQ(contentOf(folder.path("out")), "a" + large + "b");
}

TEST(AtomicFile, followsLinksAndKeepsPermissions) {
  const TempFolder folder;
  const std::string target = folder.write("target", "former");
  std::filesystem::permissions(target, std::filesystem::perms::owner_all);
  std::filesystem::create_symlink(target, folder.path("link"));
  AtomicFile file(folder.path("link"));
  file.write("new");
  file.commit();
  EXPECT_TRUE(std::filesystem::is_symlink(folder.path("link")));
  EXPECT_EQ(contentOf(target), "new");
  EXPECT_EQ(std::filesystem::status(target).permissions(), std::filesystem::perms::owner_all);
}

TEST(AtomicFile, saysWhyItCannotWrite) {
  const TempFolder folder;
  EXPECT_THROW(AtomicFile("/nowhere/at/all.ply"), IoError);
  EXPECT_THROW(AtomicFile(folder.path(".")), IoError);
  AtomicFile file("/dev/full");
  file.write("x");
  EXPECT_THROW(file.commit(), IoError);
}

TEST(AtomicFile, everyWriterReportsAFullDisk) {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  const TempFolder folder;
  for (const std::string& extension : meshWriteExtensions()) {
    const std::string path = folder.path("full" + extension);
    std::filesystem::create_symlink("/dev/full", path);
    EXPECT_THROW(writeMesh(path, mesh), IoError) << extension;
    EXPECT_THROW(writeMesh("/nowhere/a" + extension, mesh), IoError) << extension;
  }
  EXPECT_THROW(writeXyz("/dev/full", mesh.vertices), IoError);
  EXPECT_THROW(writePcd("/dev/full", {mesh.vertices, {}, {}}), IoError);
}

} // namespace
} // namespace graben
