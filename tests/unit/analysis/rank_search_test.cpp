#include "graben/analysis/rank_search.h"

#include "unit/mesh/meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace graben {
namespace {

/// The values of some ranks, the values seen in blocks of unequal sizes. \param[out] times that all had to be seen
std::vector<double> ranked(const std::vector<double>& values, const std::vector<double>& sample, const std::vector<std::size_t>& ranks, int& times) {
  RankSearch search(sample, values.size(), ranks);
  std::vector<double> found;
  std::vector<RankSearch::Tally> tallies;
  times = 0;
  do {
    tallies.clear();
    for (std::size_t begin = 0, size = 1; begin < values.size(); begin += size, size *= 3)
      tallies.emplace_back(search).see(values.data() + begin, std::min(size, values.size() - begin));
    ++times;
  } while (!search.find(tallies, found));
  return found;
}

void expectAllRanks(const std::vector<double>& values, const std::vector<double>& sample, int most_times) {
  std::vector<double> sorted = values;
  std::sort(sorted.begin(), sorted.end());
  int times = 0;
  for (std::size_t rank = 0; rank < values.size(); rank += 1 + values.size() / 50) {
    const std::vector<std::size_t> ranks{rank, values.size() - 1 - rank};
    ASSERT_EQ(ranked(values, sample, ranks, times), (std::vector<double>{sorted[rank], sorted[values.size() - 1 - rank]})) << rank;
    EXPECT_LE(times, most_times);
  }
}

TEST(RankSearch, FindsWhatStandsThereInTheSortedList) {
  std::mt19937_64 random(1);
  std::vector<double> values{0.0, 1e300, 5e-324, 400.0, std::numeric_limits<double>::infinity(), -3.0};
  std::vector<double> sample;
  for (int i = 0; i < 30000; ++i) {
    values.push_back(400.0 + test::uniform(random, 0.0, i % 2 == 0 ? 1e-9 : 1e2)); // half of them crowd
    if (i % 15 == 0)
      sample.push_back(values.back());
  }
  expectAllRanks(values, sample, 1);
  expectAllRanks(values, values, 1);
  expectAllRanks(values, {}, 1);
}

TEST(RankSearch, EqualValuesCount) {
  std::vector<double> values;
  for (int i = 0; i < 5000; ++i)
    values.push_back(i % 7);
  expectAllRanks(values, {values.begin(), values.begin() + 700}, 1);
  expectAllRanks(std::vector<double>(1000, 0.25), std::vector<double>(100, 0.25), 1);
  expectAllRanks({2.0}, {2.0}, 1);
}

TEST(RankSearch, ASampleUnlikeTheRestCostsASecondLook) {
  std::vector<double> values;
  for (int i = 0; i < 5000; ++i)
    values.push_back((i * 37) % 5000);
  expectAllRanks(values, std::vector<double>(1000, 2.0), 2);
  int times = 0;
  ranked(values, std::vector<double>(1000, 2.0), {2500}, times);
  EXPECT_EQ(times, 2);
}

TEST(RankSearch, RanksOfShares) {
  EXPECT_EQ(rankOf(100, 0.0), 0U);
  EXPECT_EQ(rankOf(100, 0.01), 0U);
  EXPECT_EQ(rankOf(100, 0.5), 49U);
  EXPECT_EQ(rankOf(100, 1.0), 99U);
}

} // namespace
} // namespace graben
