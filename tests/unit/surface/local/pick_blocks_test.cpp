#include "local/pick_blocks.h"

#include "shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace graben::detail {
namespace {

struct Picks {
  std::vector<double> points, normals;

  explicit Picks(std::size_t count) {
    test::Random random(11);
    for (std::size_t i = 0; i < count; ++i) {
      for (int axis = 0; axis < 3; ++axis)
        points.push_back(random.uniform(0.0, axis == 2 ? 1.0 : 10.0));
      const double tilt = random.uniform(0.0, 3.0);
      normals.insert(normals.end(), {std::sin(tilt), 0.0, std::cos(tilt)});
    }
    points[3 * (count / 2) + 1] = std::numeric_limits<double>::quiet_NaN();
    normals[3 * (count / 3)] = std::numeric_limits<double>::quiet_NaN();
  }

  double height(std::size_t pick, const DiscQuery& query, const std::array<double, 3>& axis) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < 3; ++i)
      sum += (points[3 * pick + i] - query.centre[i]) * axis[i];
    return sum;
  }
};

/// What is collected, with room for it.
struct Found {
  std::vector<double> u, v, height, squared;
  std::vector<std::int32_t> index;
  std::size_t count = 0;

  explicit Found(std::size_t room) : u(room), v(room), height(room), squared(room), index(room) {}
  PickArrays arrays() { return {u.data(), v.data(), height.data(), squared.data(), index.data()}; }
};

const DiscQuery kQuery{{4.0, 6.0, 0.5}, {0.8, 0.0, -0.6}, {0.0, 1.0, 0.0}, {0.6, 0.0, 0.8}, 7.0, 0.34};

Found collect(PickBlocks& blocks, const DiscQuery& query) {
  Found found(blocks.findNear(query.centre, query.squared_radius) + kLanes);
  found.count = blocks.collect(query, found.arrays());
  return found;
}

TEST(PickBlocks, FindThePicksOfAllRunsInTheRadiusThatFaceTheRightWay) {
  for (const std::size_t count : {5U, 8U, 31U, 500U}) {
    const Picks picks(count);
    std::vector<std::int32_t> backwards;
    for (std::size_t i = count; i > 3; --i)
      backwards.push_back(static_cast<std::int32_t>(i - 1));
    std::vector<double> there;
    for (const std::int32_t i : backwards)
      there.insert(there.end(), picks.points.begin() + 3 * i, picks.points.begin() + 3 * i + 3);
    PickBlocks blocks;
    blocks.clear(count);
    blocks.add({picks.points.data() + 3, 2, nullptr, 1}, picks.normals.data());
    blocks.add({there.data(), backwards.size(), backwards.data(), -1}, picks.normals.data());
    blocks.close();
    const Found found = collect(blocks, kQuery);
    std::vector<std::int32_t> expected;
    std::vector<std::int32_t> order{1, 2};
    order.insert(order.end(), backwards.begin(), backwards.end());
    for (const std::int32_t i : order) {
      const auto p = static_cast<std::size_t>(i);
      const double u = picks.height(p, kQuery, kQuery.u), v = picks.height(p, kQuery, kQuery.v), h = picks.height(p, kQuery, kQuery.normal);
      if (u * u + v * v + h * h <= kQuery.squared_radius && picks.normals[3 * p] * 0.6 + picks.normals[3 * p + 2] * 0.8 > kQuery.least_cosine)
        expected.push_back(i);
    }
    ASSERT_EQ(std::vector<std::int32_t>(found.index.begin(), found.index.begin() + static_cast<std::ptrdiff_t>(found.count)), expected);
    for (std::size_t i = 0; i < found.count; ++i) {
      const auto p = static_cast<std::size_t>(found.index[i]);
      EXPECT_NEAR(found.u[i], picks.height(p, kQuery, kQuery.u), 1e-12);
      EXPECT_NEAR(found.v[i], picks.height(p, kQuery, kQuery.v), 1e-12);
      EXPECT_NEAR(found.height[i], picks.height(p, kQuery, kQuery.normal), 1e-12);
      EXPECT_NEAR(found.squared[i], found.u[i] * found.u[i] + found.v[i] * found.v[i], 1e-12);
    }
  }
}

TEST(PickBlocks, OfBeforeAreForgotten) {
  const Picks picks(40);
  PickBlocks blocks;
  const DiscQuery everywhere{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}, 1e6, -2.0};
  for (const std::size_t count : {13U, 2U, 0U, 11U}) {
    blocks.clear(count);
    blocks.add({picks.points.data(), count, nullptr, 0}, picks.normals.data());
    blocks.close();
    EXPECT_EQ(collect(blocks, everywhere).count, count);
  }
}

TEST(SupportKernels, RangesHoldAllNumbersAndZero) {
  test::Random random(2);
  for (std::size_t count = 0; count < 14; ++count)
    for (const double middle : {-4.0, 0.0, 4.0}) {
      std::vector<double> numbers(roundUpToLanes(count), 99.0);
      double low = 0.0, high = 0.0;
      for (std::size_t i = 0; i < count; ++i) {
        numbers[i] = middle + random.uniform(-1.0, 1.0);
        low = std::min(low, numbers[i]);
        high = std::max(high, numbers[i]);
      }
      const Range range = rangeWithZero(numbers.data(), count);
      EXPECT_EQ(range.low, low);
      EXPECT_EQ(range.high, high);
    }
}

TEST(SupportKernels, KeepWithinKeepsTheNearOnesInTheirOrder) {
  for (std::size_t count = 0; count < 14; ++count) {
    Found found(roundUpToLanes(count));
    std::vector<std::int32_t> expected;
    for (std::size_t i = 0; i < count; ++i) {
      found.squared[i] = static_cast<double>(i * 7 % 5);
      found.index[i] = static_cast<std::int32_t>(i);
      found.u[i] = static_cast<double>(i);
      found.v[i] = 2.0 * found.u[i];
      found.height[i] = 3.0 * found.u[i];
      if (found.squared[i] <= 2.0)
        expected.push_back(found.index[i]);
    }
    ASSERT_EQ(keepWithin(2.0, found.arrays(), count), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
      EXPECT_EQ(found.index[i], expected[i]);
      EXPECT_EQ(found.u[i], expected[i]);
      EXPECT_EQ(found.v[i], 2.0 * expected[i]);
      EXPECT_EQ(found.height[i], 3.0 * expected[i]);
      EXPECT_LE(found.squared[i], 2.0);
    }
  }
}

} // namespace
} // namespace graben::detail
