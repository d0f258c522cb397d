#include "graben/core/atomic_file.h"
#include "graben/core/errors.h"
#include "support/temp_folder.h"

#include <gtest/gtest.h>

namespace graben {
namespace {

namespace fs = std::filesystem;
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

TEST(AtomicFile, isOneCallForBytesAtHand) {
  const TempFolder folder;
  const std::string path = folder.write("out.txt", "former");
  writeFile(path, std::string("a\0b", 3));
  EXPECT_EQ(contentOf(path), std::string("a\0b", 3));
  writeFile(path, {});
  EXPECT_EQ(contentOf(path), "");
  EXPECT_EQ(folder.count(), 1U);
  EXPECT_THROW(writeFile(folder.path("none/out.txt"), "new"), WriteError);
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
  fs::permissions(target, fs::perms::owner_all);
  fs::create_symlink(target, folder.path("link"));
  AtomicFile file(folder.path("link"));
  file.write("new");
  file.commit();
  EXPECT_TRUE(fs::is_symlink(folder.path("link")));
  EXPECT_EQ(contentOf(target), "new");
  EXPECT_EQ(fs::status(target).permissions(), fs::perms::owner_all);
}

TEST(AtomicFile, saysWhyItCannotWrite) {
  const TempFolder folder;
  EXPECT_THROW(AtomicFile("/nowhere/at/all.ply"), WriteError);
  EXPECT_THROW(AtomicFile(folder.path(".")), WriteError);
  AtomicFile file("/dev/full");
  file.write("x");
  EXPECT_THROW(file.commit(), WriteError);
}

TEST(AtomicFile, followsALinkToAFileThatIsNotThere) {
  const TempFolder folder;
  fs::create_directory(folder.path("below"));
  fs::create_symlink("below/target", folder.path("second"));
  fs::create_symlink("second", folder.path("first"));
  AtomicFile file(folder.path("first"));
  file.write("new");
  file.commit();
  EXPECT_TRUE(fs::is_symlink(folder.path("first")));
  EXPECT_EQ(contentOf(folder.path("below/target")), "new");
}

TEST(AtomicFile, doesNotReplaceAWriteProtectedFile) {
  const TempFolder folder;
  const std::string path = folder.write("out", "former");
  fs::permissions(path, fs::perms::owner_read | fs::perms::group_read);
  EXPECT_THROW(AtomicFile{path}, WriteError);
  EXPECT_THROW(checkWritable(path), WriteError);
  fs::create_symlink("out", folder.path("link"));
  EXPECT_THROW(AtomicFile(folder.path("link")), WriteError);
  EXPECT_EQ(contentOf(path), "former");
  EXPECT_EQ(folder.count(), 2U);
}

TEST(AtomicFile, longNamesHaveRoomForTheTemporaryOne) {
  const TempFolder folder;
  const std::string path = folder.path(std::string(255, 'n'));
  AtomicFile file(path);
  file.write("new");
  file.commit();
  EXPECT_EQ(contentOf(path), "new");
  EXPECT_THROW(AtomicFile(path + "n"), WriteError);
}

TEST(AtomicFile, checkLeavesEverythingAsItWas) {
  const TempFolder folder;
  const std::string path = folder.write("out", "former");
  checkWritable(path);
  checkWritable(folder.path("other"));
  checkWritable("/dev/null");
  EXPECT_EQ(contentOf(path), "former");
  EXPECT_EQ(folder.count(), 1U);
  EXPECT_THROW(checkWritable(folder.path("no/file")), WriteError);
  EXPECT_THROW(checkWritable(folder.path(".")), WriteError);
}

TEST(AtomicFile, isRemovedByWhoEndsTheProgram) {
  const TempFolder folder;
  AtomicFile file(folder.path("out"));
  file.write("new");
  EXPECT_EQ(folder.count(), 1U);
  removeUnfinishedFiles();
  EXPECT_EQ(folder.count(), 0U);
  EXPECT_THROW(file.commit(), WriteError);
}

} // namespace
} // namespace graben
