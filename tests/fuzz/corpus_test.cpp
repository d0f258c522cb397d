// Every file of the corpus through its target, with the compiler and options graben is built with. GRABEN_FUZZ_TARGETS: which targets.
#include "fuzz_targets.h"

#include "support/temp_folder.h"

#include <gtest/gtest.h>

namespace graben::test {
namespace {

class Corpus : public testing::TestWithParam<FuzzTarget> {};

TEST_P(Corpus, givesResultsOrErrors) {
  const FuzzTarget& target = GetParam();
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(GRABEN_SOURCE_DIR) / "tests/fuzz/corpus" / target.name)) {
    const std::string content = contentOf(entry.path().string());
    EXPECT_LE(content.size(), target.longest) << entry.path();
    EXPECT_NO_THROW(target.run(reinterpret_cast<const std::uint8_t*>(content.data()), content.size())) << entry.path();
    ++files;
  }
  EXPECT_GT(files, 0U);
}

INSTANTIATE_TEST_SUITE_P(GRABEN_FUZZ_TARGETS, Corpus, testing::ValuesIn(GRABEN_FUZZ_TARGETS()), [](const auto& tested) { return tested.param.name; });

} // namespace

void PrintTo(const FuzzTarget& target, std::ostream* out) { *out << target.name; }

} // namespace graben::test
