#include "graben/core/errors.h"
#include "graben/core/file_set.h"
#include "support/temp_folder.h"

#include <gmock/gmock.h>

namespace graben {
namespace {

namespace fs = std::filesystem;
using test::contentOf;
using test::TempFolder;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const FileSetNames kNames{"set.manifest", "seal", "incomplete"};

void put(const std::string& folder, const std::string& name, const std::string& text) { std::ofstream(folder + "/" + name) << text; }

/// Writes the set of those names, each with its name as content, and the seal.
std::vector<std::string> writeSet(const std::string& folder, const std::vector<std::string>& names) {
  FileSet set(folder, kNames);
  for (const std::string& name : names)
    put(set.staging(), name, name);
  put(set.staging(), "seal", "whole");
  return set.commit();
}

std::vector<std::string> namesOf(const std::string& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder))
    names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

TEST(FileSet, replacesTheFormerSetAndNothingElse) {
  const TempFolder temp;
  const std::string folder = temp.path("a/b");
  EXPECT_THAT(writeSet(folder, {"one", "two"}), ElementsAre("one", "seal", "set.manifest", "two"));
  put(folder, "mine", "mine");
  put(folder, "two.mine", "mine");
  writeSet(folder, {"one", "three"});
  EXPECT_THAT(namesOf(folder), ElementsAre("mine", "one", "seal", "set.manifest", "three", "two.mine"));
  EXPECT_EQ(contentOf(folder + "/seal"), "whole");
}

TEST(FileSet, standsUntilTheNextIsCommitted) {
  const TempFolder temp;
  const std::string folder = temp.path("r");
  writeSet(folder, {"one"});
  {
    FileSet next(folder, kNames);
    put(next.staging(), "one", "new");
    EXPECT_EQ(contentOf(folder + "/one"), "one");
  }
  EXPECT_THAT(namesOf(folder), ElementsAre("one", "seal", "set.manifest"));
  { const FileSet never(temp.path("x/y"), kNames); }
  EXPECT_FALSE(fs::exists(temp.path("x")));
}

TEST(FileSet, refusesFilesThatAreNotFromAFormerSet) {
  const TempFolder temp;
  const std::string folder = temp.path("r");
  writeSet(folder, {"one"});
  put(folder, "two", "mine");
  EXPECT_THAT(FileSet::notOfTheSet(folder, kNames, {"one", "two", "three"}), ElementsAre("two"));
  EXPECT_THROW(writeSet(folder, {"one", "two"}), WriteError);
  EXPECT_EQ(contentOf(folder + "/two"), "mine");
  EXPECT_EQ(contentOf(folder + "/seal"), "whole");
  EXPECT_THAT(namesOf(folder), ElementsAre("one", "seal", "set.manifest", "two"));
}

TEST(FileSet, keepsFilesInFoldersBelow) {
  const TempFolder temp;
  const std::string folder = temp.path("r");
  const auto write = [&](const std::vector<std::string>& names) {
    FileSet set(folder, kNames);
    for (const std::string& name : names) {
      fs::create_directories(fs::path(set.staging() + "/" + name).parent_path());
      put(set.staging(), name, name);
    }
    put(set.staging(), "seal", "whole");
    return set.commit();
  };
  EXPECT_THAT(write({"blocks/a", "blocks/b", "x/y/z"}), ElementsAre("blocks/a", "blocks/b", "seal", "set.manifest", "x/y/z"));
  put(folder, "blocks/mine", "mine");
  write({"blocks/a"});
  EXPECT_THAT(namesOf(folder), ElementsAre("blocks", "seal", "set.manifest"));
  EXPECT_THAT(namesOf(folder + "/blocks"), ElementsAre("a", "mine"));
  EXPECT_THROW(write({"blocks/mine"}), WriteError);
  EXPECT_EQ(contentOf(folder + "/blocks/mine"), "mine");
  fs::create_directory(temp.path("elsewhere"));
  put(temp.path("elsewhere"), "one", "mine");
  fs::create_directory_symlink(temp.path("elsewhere"), folder + "/link");
  EXPECT_THROW(write({"link/two"}), WriteError) << "a link leads out of the folder";
  std::ofstream(folder + "/set.manifest", std::ios::app) << "link/one\n../elsewhere/one\n";
  write({"blocks/a"});
  EXPECT_THAT(namesOf(temp.path("elsewhere")), ElementsAre("one"));
}

TEST(FileSet, takesALinkForTheOwnersFile) {
  const TempFolder temp;
  const std::string folder = temp.path("r");
  writeSet(folder, {"one", "two"});
  put(folder, "mine", "mine");
  fs::remove(folder + "/one");
  fs::create_symlink("mine", folder + "/one");
  EXPECT_THROW(writeSet(folder, {"one"}), WriteError);
  writeSet(folder, {"two"});
  EXPECT_TRUE(fs::is_symlink(folder + "/one"));
  EXPECT_EQ(contentOf(folder + "/mine"), "mine");
}

TEST(FileSet, manifestCannotNameFilesElsewhere) {
  const TempFolder temp;
  const std::string folder = temp.path("r");
  writeSet(folder, {"one"});
  temp.write("mine", "mine");
  fs::create_directory(folder + "/below");
  put(folder + "/below", "mine", "mine");
  std::ofstream(folder + "/set.manifest", std::ios::app) << "../mine\nbelow\nbelow/../below/mine\nbelow/../../mine\n.\n..\n\n";
  writeSet(folder, {"two"});
  EXPECT_EQ(contentOf(temp.path("mine")), "mine");
  EXPECT_EQ(contentOf(folder + "/below/mine"), "mine");
  EXPECT_FALSE(fs::exists(folder + "/one"));
}

TEST(FileSet, somethingElseIsNoManifest) {
  const TempFolder temp;
  put(temp.path("."), "set.manifest", "one\n");
  put(temp.path("."), "one", "mine");
  EXPECT_THAT(FileSet::namesIn(temp.path("."), kNames), IsEmpty());
  EXPECT_THROW(writeSet(temp.path("."), {"two"}), WriteError);
}

TEST(FileSet, putsRightWhatAnInterruptedExchangeLeft) {
  const TempFolder temp;
  const std::string folder = temp.path("r");
  writeSet(folder, {"one", "two"});
  put(folder, "seal", "incomplete");
  std::ofstream(folder + "/set.manifest", std::ios::app) << "three\nfour\n";
  put(folder, "three", "half");
  writeSet(folder, {"one"});
  EXPECT_THAT(namesOf(folder), ElementsAre("one", "seal", "set.manifest"));
}

TEST(FileSet, errorsAreToldOfTheFinalPlace) {
  const TempFolder temp;
  const FileSet set(temp.path("r"), kNames);
  const WriteError error = set.inPlace(IoError(set.staging() + "/one", "cannot be written: why"));
  EXPECT_EQ(error.what(), temp.path("r") + "/one: cannot be written: why");
  temp.write("file", "");
  EXPECT_THROW(FileSet(temp.path("file"), kNames), WriteError);
  EXPECT_THROW(FileSet(temp.path("file/below"), kNames), WriteError);
  EXPECT_THROW(checkFolderWritable(temp.path("file/below")), WriteError);
  EXPECT_NO_THROW(checkFolderWritable(temp.path("none/below")));
}

TEST(FileSet, whatAKilledRunLeftIsTakenAway) {
  const TempFolder temp;
  const std::string folder = temp.path("r");
  std::string left;
  {
    const FileSet running(folder, kNames);
    left = running.staging();
    put(left, "one", "half");
    const FileSet beside(folder, kNames);
    EXPECT_TRUE(fs::exists(left));
  }
  const std::size_t process = left.find(".part-") + 6;
  left.replace(process, left.find('-', process) - process, "4194305"); // more than any process number
  fs::create_directories(left);
  put(left, "one", "half");
  writeSet(folder, {"one"});
  EXPECT_FALSE(fs::exists(left));
}

} // namespace
} // namespace graben
