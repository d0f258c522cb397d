// A table of bad inputs: for each the exit code, what the error says, and that nothing was written.
#include "bad_input.h"

#include "support/tool.h"

#include <gmock/gmock.h>

#include <iostream>

namespace graben::test {

std::string goodPicks() {
  return rows(400, [](int i) {
    return std::to_string(10 * (i / 20) + i % 3) + " " + std::to_string(10 * (i % 20) + i / 20 % 3) + " " + std::to_string(100 + i % 2);
  });
}

std::string goodSticks() { return "95 -50 50\n105 -50 150\n999 999 999\n95 95 50\n105 95 150\n999 999 999\n95 250 50\n105 250 150\n999 999 999\n"; }

namespace {

using testing::HasSubstr;

std::vector<BadInput> allRows() {
  std::vector<BadInput> all;
  for (const auto& part : {badTextPicks(), badBinaryPicks(), badFaults(), badUse()})
    all.insert(all.end(), part.begin(), part.end());
  return all;
}

bool has(const std::string& arguments, const std::string& option) { return (" " + arguments).find(" " + option + " ") != std::string::npos; }

/// The row's arguments, and for each option they do not give the good file.
std::string everyJob(const std::string& arguments) {
  std::string all = arguments;
  for (const auto& [option, file] :
       {std::pair("--horizon", "picks.xyz"), std::pair("--fault", "fault.pol"), std::pair("--output", "top.ply"), std::pair("--report", "report.json")})
    if (!has(arguments, option))
      all = std::string(option) + " " + file + " " + all;
  return all;
}

class BadInputs : public ToolTest, public testing::WithParamInterface<BadInput> {
protected:
  void SetUp() override {
    ToolTest::SetUp();
    write("picks.xyz", goodPicks());
    write("picks.ply", "ply\nformat ascii 1.0\nelement vertex 0\nend_header\n");
    write("fault.pol", goodSticks());
    std::filesystem::create_directory(path("folder.ply"));
    for (const char* link : {"full.ply", "full.vtk"})
      std::filesystem::create_symlink("/dev/full", path(link));
    for (const auto& [name, content] : GetParam().files)
      write(name, content);
  }
};

TEST_P(BadInputs, areTold) {
  const BadInput& row = GetParam();
  const std::set<std::string> before = names();
  const Outcome outcome = run("reconstruct", everyJob(row.arguments), "timeout 60");
  std::cout << outcome.code << " " << outcome.errors.substr(0, 1500);
  EXPECT_EQ(outcome.code, row.code);
  EXPECT_THAT(outcome.errors, HasSubstr(row.says));
  if (row.code == 0) {
    EXPECT_EQ(names().size(), before.size() + 2) << "the surface and the report";
    return;
  }
  EXPECT_EQ(names(), before);
  const std::size_t error = outcome.errors.find("graben_reconstruct: error: ");
  ASSERT_NE(error, std::string::npos);
  EXPECT_EQ(outcome.errors.find('\n', error), outcome.errors.size() - 1) << "the error is one line, the last";
  EXPECT_LT(outcome.errors.size() - error, 1200U) << "and no longer than can be read";
  EXPECT_EQ(outcome.errors.find("ERR|"), std::string::npos) << "VTK says nothing of its own";
}

INSTANTIATE_TEST_SUITE_P(Table, BadInputs, testing::ValuesIn(allRows()), [](const auto& tested) { return tested.param.name; });

} // namespace

void PrintTo(const BadInput& row, std::ostream* out) { *out << row.arguments; }

} // namespace graben::test
