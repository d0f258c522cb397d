#include "cases.h"

#include "graben/core/errors.h"

#include <cmath>
#include <cstring>

namespace graben {
namespace {

using test::EveryKind;

class Picks : public EveryKind {};

TEST_P(Picks, SameBytesForEveryNumberOfThreads) {
  SyntheticOptions o = options();
  o.picks = 50001;
  o.uneven = 0.7;
  const SyntheticModel model(o);
  const SyntheticPicks one = model.picks(1);
  const SyntheticPicks four = model.picks(4);
  ASSERT_EQ(one.points.size(), 50001u);
  ASSERT_EQ(four.points.size(), 50001u);
  EXPECT_EQ(std::memcmp(one.points.data(), four.points.data(), one.points.size() * sizeof(Vector3)),
            0);
  EXPECT_EQ(one.block, four.block);
  EXPECT_EQ(model.pick(777).position, one.points[777]);
}

TEST_P(Picks, AllBlocksArePickedInsideTheArea) {
  const SyntheticModel model(options());
  const SyntheticPicks picks = model.picks();
  std::vector<int> count(model.blockCount());
  for (std::size_t i = 0; i < picks.points.size(); ++i) {
    ++count[static_cast<std::size_t>(picks.block[i])];
    EXPECT_LE(picks.points[i].head<2>().cwiseAbs().maxCoeff(), 0.5 * model.options().size);
  }
  for (const int n : count)
    EXPECT_GT(n, 1000);
}

INSTANTIATE_TEST_SUITE_P(, Picks, testing::ValuesIn(test::allKinds()), test::nameOf);

TEST(PickNoise, HasTheSpreadAskedForAndIsVertical) {
  for (const double sigma : {0.0, 2.0, 12.0}) {
    SyntheticOptions o;
    o.noise = sigma;
    const SyntheticModel model(o);
    double sum = 0.0, squares = 0.0, fourths = 0.0;
    const int n = 60000;
    for (int i = 0; i < n; ++i) {
      const SyntheticPick pick = model.pick(static_cast<std::uint64_t>(i));
      EXPECT_EQ(pick.position.head<2>(), pick.truth.head<2>());
      const double e = pick.position.z() - pick.truth.z();
      sum += e;
      squares += e * e;
      fourths += e * e * e * e;
    }
    EXPECT_NEAR(sum / n, 0.0, 0.02 * sigma);
    EXPECT_NEAR(std::sqrt(squares / n), sigma, 0.015 * sigma);
    EXPECT_NEAR(fourths / n, 3.0 * std::pow(sigma, 4), 0.15 * std::pow(sigma, 4)); // Gaussian
  }
}

TEST(PickSeed, ChangesThePicks) {
  SyntheticOptions o;
  const Vector3 first = SyntheticModel(o).pick(5).position;
  o.seed = 2;
  EXPECT_GT((SyntheticModel(o).pick(5).position - first).norm(), 1.0);
}

int countIn(const SyntheticPicks& picks, double x, double y, double radius) {
  int n = 0;
  for (const Vector3& p : picks.points)
    n += std::hypot(p.x() - x, p.y() - y) < radius ? 1 : 0;
  return n;
}

TEST(PickDensity, IsEvenByDefaultAndHasHolesAndPatches) {
  SyntheticOptions o = SyntheticOptions::of(SyntheticKind::Unfaulted);
  const double expected = 60000.0 / 36e6 * 3.14159 * 500.0 * 500.0;
  SyntheticPicks picks = SyntheticModel(o).picks();
  for (const double x : {-2000.0, 0.0, 2000.0})
    EXPECT_NEAR(countIn(picks, x, 1000.0, 500.0), expected, 5.0 * std::sqrt(expected));
  o.holes = {{1000.0, -500.0, 400.0}};
  o.patches = {{{-1000.0, 0.0, 600.0}, 6.0}};
  picks = SyntheticModel(o).picks();
  EXPECT_EQ(countIn(picks, 1000.0, -500.0, 400.0), 0);
  const double ratio = countIn(picks, -1000.0, 0.0, 500.0) /
                       static_cast<double>(countIn(picks, 1500.0, 1500.0, 500.0));
  EXPECT_NEAR(ratio, 6.0, 0.8);
}

TEST(PickDensity, UnevenSamplingVariesByTen) {
  SyntheticOptions o = SyntheticOptions::of(SyntheticKind::Unfaulted);
  o.picks = 400000;
  o.uneven = 1.0;
  const SyntheticPicks picks = SyntheticModel(o).picks();
  std::vector<int> cells(40 * 40);
  for (const Vector3& p : picks.points)
    ++cells[static_cast<std::size_t>(std::min(39.0, (p.x() + 3000.0) / 150.0)) * 40 +
            static_cast<std::size_t>(std::min(39.0, (p.y() + 3000.0) / 150.0))];
  const auto [least, most] = std::minmax_element(cells.begin(), cells.end());
  EXPECT_GT(*most, 6 * *least);
  EXPECT_GT(*least, 20);
}

TEST(PickDensity, ReverseFaultIsPickedOnBothSheets) {
  SyntheticOptions o = SyntheticOptions::of(SyntheticKind::Reverse);
  o.picks = 200000;
  const SyntheticModel model(o);
  const SyntheticPicks picks = model.picks();
  int overlap[2] = {0, 0};
  for (std::size_t i = 0; i < picks.points.size(); ++i)
    if (model.sheetCovers(0, picks.points[i].x(), picks.points[i].y()) &&
        model.sheetCovers(1, picks.points[i].x(), picks.points[i].y()))
      ++overlap[picks.block[i]];
  // Each sheet has the full density there: 200,000 over 36.3 square kilometres, times 0.304.
  EXPECT_NEAR(overlap[0], 1675, 170);
  EXPECT_NEAR(overlap[1], 1675, 170);
}

TEST(PickGap, KeepsPicksAwayFromTheFaultOnlyWhereThereIsOne) {
  SyntheticOptions o = SyntheticOptions::of(SyntheticKind::Tip);
  o.gap = 80.0;
  const SyntheticModel model(o);
  const SyntheticPicks picks = model.picks();
  const Vector3 tip = model.cutoffLines()[0].points.back();
  int beyond = 0;
  for (std::uint64_t i = 0; i < o.picks; ++i) {
    const SyntheticPick pick = model.pick(i);
    const double distance =
        std::abs(model.faultOffset(0, pick.truth)) * std::sin(60.0 * 3.14159265 / 180.0);
    EXPECT_FALSE(distance < 79.9 && pick.truth.y() < tip.y() - 50.0);
    beyond += distance < 80.0 ? 1 : 0;
    EXPECT_GT((pick.truth - tip).norm(), 79.0);
  }
  EXPECT_GT(beyond, 500);
}

TEST(PickSmear, MovesPicksNearTheFaultAcrossItAndKeepsTheirHeight) {
  SyntheticOptions o;
  o.smear = 60.0;
  o.noise = 0.0;
  const SyntheticModel model(o);
  int moved = 0, wrong_side = 0;
  for (std::uint64_t i = 0; i < o.picks; ++i) {
    const SyntheticPick pick = model.pick(i);
    const double shift = (pick.position - pick.truth).norm();
    EXPECT_EQ(pick.position.z(), pick.truth.z());
    EXPECT_LE(shift, 60.0);
    moved += shift > 0.0 ? 1 : 0;
    if (shift > 0.0) {
      EXPECT_LT(std::abs(model.faultOffset(0, pick.truth)),
                60.0 / std::sin(60.0 * 3.14159265 / 180.0) + 0.1);
    }
    wrong_side += model.blockOf(pick.position) != pick.block ? 1 : 0;
  }
  EXPECT_GT(moved, 1000);
  EXPECT_GT(wrong_side, moved / 8);
}

TEST(PickRoom, NoRoomIsAnError) {
  SyntheticOptions o;
  o.holes = {{0.0, 0.0, 5000.0}};
  const SyntheticModel model(o);
  EXPECT_THROW(model.pick(0), InvalidInputError);
  EXPECT_THROW(model.picks(4), InvalidInputError);
}

} // namespace
} // namespace graben
