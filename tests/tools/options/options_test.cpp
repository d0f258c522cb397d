#include "support/run.h"

#include "graben/core/errors.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace graben {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

OptionParser sample() {
  OptionParser parser("graben_sample", "A sample.");
  parser.list("fault", "FILE", "faults")
      .value("voxel-size", "H", "cell edge", "2.5")
      .value("origin", "X,Y,Z", "origin");
  return parser.flag("quiet", "say nothing");
}

std::string usageError(const std::vector<std::string>& arguments) {
  try {
    sample().parse(arguments);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "no error";
}

class ConfigFile {
public:
  explicit ConfigFile(const std::string& content)
      : path_(std::filesystem::temp_directory_path() /
              ("graben_options_" +
               std::string(testing::UnitTest::GetInstance()->current_test_info()->name()))) {
    std::ofstream(path_) << content;
  }
  ~ConfigFile() { std::filesystem::remove(path_); }
  std::string path() const { return path_.string(); }

private:
  std::filesystem::path path_;
};

TEST(Options, ListTakesWordsUpToTheNextOptionAndRepeats) {
  const OptionValues values = sample().parse({"--fault", "a", "b", "--quiet", "--fault=c"});
  EXPECT_THAT(values.texts("fault"), ElementsAre("a", "b", "c"));
  EXPECT_TRUE(values.has("quiet"));
}

TEST(Options, DefaultsAreReadButNotGiven) {
  const OptionValues values = sample().parse({});
  EXPECT_EQ(values.number("voxel-size"), 2.5);
  EXPECT_FALSE(values.has("voxel-size"));
  EXPECT_TRUE(values.texts("fault").empty());
}

TEST(Options, NegativeNumbersAreValues) {
  const OptionValues values = sample().parse({"--voxel-size", "-5e1", "--origin", "-1,2.5,+3"});
  EXPECT_EQ(values.number("voxel-size"), -50.0);
  EXPECT_THAT(values.numbers("origin", 3), ElementsAre(-1.0, 2.5, 3.0));
}

TEST(Options, UnknownOptionNamesTheNearest) {
  EXPECT_THAT(usageError({"--fualt", "x"}),
              HasSubstr("unknown option --fualt; did you mean --fault?"));
  EXPECT_THAT(usageError({"--voxel", "x"}), HasSubstr("did you mean --voxel-size?"));
  EXPECT_THAT(usageError({"--xyzzyplugh"}), testing::Not(HasSubstr("did you mean")));
  EXPECT_THAT(usageError({"-q"}), HasSubstr("unknown option -q"));
}

TEST(Options, WrongUseIsNamed) {
  EXPECT_THAT(usageError({"--fault"}), HasSubstr("--fault needs a value"));
  EXPECT_THAT(usageError({"--voxel-size", "--quiet"}), HasSubstr("--voxel-size needs a value"));
  EXPECT_THAT(usageError({"--quiet=1"}), HasSubstr("takes no value"));
  EXPECT_THAT(usageError({"--voxel-size", "1", "--voxel-size", "2"}), HasSubstr("given twice"));
  EXPECT_THAT(usageError({"stray"}), HasSubstr("'stray' belongs to no option"));
  EXPECT_THAT(usageError({"--voxel-size="}), HasSubstr("empty value"));
}

TEST(Options, BadNumbersNameTheOption) {
  for (const char* bad : {"abc", "1.5x", "", "nan", "inf", "1,2", "0x10", "1e999"}) {
    OptionParser parser("t", "");
    parser.value("size", "S", "size").value("other", "O", "other", "x");
    const OptionValues values = parser.parse({"--size", *bad ? bad : "+"});
    EXPECT_THROW(values.number("size"), UsageError) << bad;
  }
  const OptionValues values = sample().parse({"--voxel-size", "7.5", "--origin", "1,2"});
  EXPECT_THROW(values.number("voxel-size", 0.0, 5.0), UsageError);
  EXPECT_THROW(values.integer("voxel-size"), UsageError);
  EXPECT_THROW(values.numbers("origin", 3), UsageError);
  EXPECT_THROW(values.choice("voxel-size", {"a", "b"}), UsageError);
  EXPECT_EQ(sample().parse({"--voxel-size", "2e6"}).integer("voxel-size"), 2000000);
}

TEST(Options, CommandLineWinsOverConfig) {
  const ConfigFile file(
      "# comment\r\nvoxel-size = 4\r\n\nfault = a \"b c\"\nfault = d\nquiet = yes\norigin=1,2,3\n");
  OptionValues values = sample().parse({"--config", file.path(), "--voxel-size", "9"});
  EXPECT_EQ(values.number("voxel-size"), 9.0);
  EXPECT_THAT(values.texts("fault"), ElementsAre("a", "b c", "d"));
  EXPECT_TRUE(values.has("quiet"));
  values = sample().parse({"--config", file.path(), "--fault", "z"});
  EXPECT_THAT(values.texts("fault"), ElementsAre("z"));
}

TEST(Options, ConfigMistakesNameFileAndLine) {
  const ConfigFile file("quiet = no\nvoxelsize = 4\n");
  EXPECT_THAT(usageError({"--config", file.path()}),
              HasSubstr(file.path() + ":2: unknown option --voxelsize"));
  EXPECT_THROW(sample().parse({"--config", "/no/such/file"}), IoError);
}

TEST(Options, UndeclaredNamesAreAMistakeInTheTool) {
  EXPECT_THROW(sample().parse({}).has("nothing"), std::logic_error);
  EXPECT_THROW(sample().flag("quiet", ""), std::logic_error);
}

TEST(Options, PositionalsAreCounted) {
  OptionParser parser("t", "");
  parser.positionals("INPUT", "input", 1, 2).flag("x", "");
  EXPECT_THAT(parser.parse({"a", "--x", "--", "--b"}).positionals(), ElementsAre("a", "--b"));
  EXPECT_THROW(parser.parse({"--x"}), UsageError);
  EXPECT_THROW(parser.parse({"a", "b", "c"}), UsageError);
}

int run(const std::vector<const char*>& arguments,
        const std::function<int(const OptionValues&)>& body) {
  std::vector<const char*> argv = {"graben_sample"};
  argv.insert(argv.end(), arguments.begin(), arguments.end());
  return runTool(sample(), static_cast<int>(argv.size()), argv.data(), body);
}

TEST(RunTool, ExitCodesAndMessages) {
  testing::internal::CaptureStderr();
  testing::internal::CaptureStdout();
  EXPECT_EQ(run({}, [](const OptionValues&) { return 0; }), 0);
  EXPECT_EQ(run({"--nonsense"}, [](const OptionValues&) { return 0; }), 2);
  EXPECT_EQ(run({},
                [](const OptionValues&) -> int {
                  throw InvalidInputError("reading", "all points are NaN");
                }),
            1);
  EXPECT_EQ(run({}, [](const OptionValues&) -> int { throw WriteError("out.ply", "cannot be written: no room"); }), 4);
  EXPECT_EQ(run({}, [](const OptionValues&) -> int { throw std::bad_alloc(); }), 1);
  EXPECT_EQ(run({}, [](const OptionValues&) -> int { throw std::out_of_range("mistake"); }), 5);
  EXPECT_EQ(run({}, [](const OptionValues&) -> int { throw 5; }), 5);
  EXPECT_EQ(run({"--fault", "x", "--help", "--nonsense"}, [](const OptionValues&) { return 7; }),
            0);
  EXPECT_EQ(run({"--version"}, [](const OptionValues&) { return 7; }), 0);
  const std::string errors = testing::internal::GetCapturedStderr();
  const std::string output = testing::internal::GetCapturedStdout();
  EXPECT_THAT(errors, HasSubstr("graben_sample: error: unknown option --nonsense"));
  EXPECT_THAT(errors, HasSubstr("graben_sample: error: reading: all points are NaN\n"));
  EXPECT_THAT(output, HasSubstr("--voxel-size H"));
  EXPECT_THAT(output, HasSubstr("(default 2.5)"));
}

} // namespace
} // namespace graben
