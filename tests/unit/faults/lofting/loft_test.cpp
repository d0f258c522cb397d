#include "graben/faults/fault_surface.h"

#include "graben/core/errors.h"
#include "graben/mesh/adjacency.h"
#include "graben/mesh/components.h"
#include "graben/mesh/triangle_bvh.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <ostream>
#include <set>

using namespace graben;
using test::Random;

namespace {

using Trace = std::function<Vector3(double)>; // s in [0, 1] along strike

/// Sticks of uneven length and spacing along a trace, dipping to the right of it.
std::vector<FaultStick> sticksAlong(const Trace& trace, int count, std::uint64_t seed) {
  Random random(seed);
  std::vector<FaultStick> sticks;
  for (int i = 0; i < count; ++i) {
    const double s = (i + random.in(-0.3, 0.3)) / (count - 1);
    const Vector3 at = trace(s);
    const Vector3 along = (trace(s + 1e-4) - trace(s - 1e-4)).normalized();
    const Vector3 down = Vector3(along.y(), -along.x(), -1.2).normalized();
    const int points = 2 + static_cast<int>(random.below(5));
    const double from = random.in(-60.0, 60.0);
    const double length = random.in(150.0, 500.0);
    FaultStick stick;
    for (int k = 0; k < points; ++k)
      stick.points.push_back(at + (from + length * k / (points - 1)) * down + random.point(0.5));
    sticks.push_back(stick);
  }
  return sticks;
}

using Corners = std::array<std::array<double, 3>, 3>;

std::multiset<Corners> geometry(const TriangleMesh& mesh) {
  std::multiset<Corners> result;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    Corners c;
    const Points p = test::corners(mesh, t);
    for (std::size_t k = 0; k < 3; ++k)
      c[k] = {p[k].x(), p[k].y(), p[k].z()};
    std::rotate(c.begin(), std::min_element(c.begin(), c.end()), c.end());
    result.insert(c);
  }
  return result;
}

void expectOneStripWithoutFolds(const TriangleMesh& mesh) {
  const EdgeAdjacency adjacency(mesh);
  EXPECT_EQ(connectedComponents(mesh).triangle_count.size(), 1U);
  EXPECT_EQ(borderLoops(mesh, adjacency).size(), 1U);
  for (std::size_t h = 0; h < 3 * mesh.triangles.size(); ++h)
    EXPECT_NE(adjacency.twin(static_cast<Index>(h)), EdgeAdjacency::kNonManifold);
}

Vector3 straight(double s) {
  return {5000.0 * s, 800.0 * s, -1500.0};
}
Vector3 arc(double s) {
  return {2000.0 * std::cos(4.0 * s), 2000.0 * std::sin(4.0 * s), -1500.0};
}
Vector3 snake(double s) {
  return {4000.0 * s, 400.0 * std::sin(7.0 * s), -1500.0 + 300.0 * s};
}
Vector3 hook(double s) {
  return s < 0.6 ? Vector3(5000.0 * s, 0.0, 0.0)
                 : Vector3(3000.0 + 700.0 * std::sin(7.0 * (s - 0.6)),
                           700.0 - 700.0 * std::cos(7.0 * (s - 0.6)), 0.0);
}

struct LoftCase {
  const char* name;
  Trace trace;
  int sticks;

  friend void PrintTo(const LoftCase& loft, std::ostream* out) { *out << loft.sticks << " sticks, " << loft.name; }
};

class Loft : public testing::TestWithParam<LoftCase> {};

} // namespace

TEST_P(Loft, FindsTheOrderWhateverTheNumberingAndDirection) {
  const std::vector<FaultStick> sticks = sticksAlong(GetParam().trace, GetParam().sticks, 3);
  const FaultSurface reference = FaultSurface::loft("reference", sticks);
  expectOneStripWithoutFolds(reference.mesh);
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    Random random(seed);
    std::vector<std::size_t> numbering(sticks.size());
    for (std::size_t i = 0; i < numbering.size(); ++i)
      numbering[i] = i;
    random.shuffle(numbering);
    std::vector<FaultStick> mixed;
    for (const std::size_t i : numbering) {
      mixed.push_back(sticks[i]);
      if (random.in(0.0, 1.0) < 0.5)
        std::reverse(mixed.back().points.begin(), mixed.back().points.end());
    }
    const StickOrder order = orderSticks(mixed);
    ASSERT_EQ(order.order.size(), sticks.size());
    std::vector<std::size_t> found;
    for (const std::size_t i : order.order) {
      found.push_back(numbering[i]);
      const Points& p = mixed[i].points;
      EXPECT_EQ(order.reversed[i], p.back().z() > p.front().z());
    }
    if (found.front() > found.back())
      std::reverse(found.begin(), found.end());
    EXPECT_TRUE(std::is_sorted(found.begin(), found.end())) << testing::PrintToString(found);
    EXPECT_EQ(geometry(FaultSurface::loft("mixed", mixed).mesh), geometry(reference.mesh));
  }
}

TEST_P(Loft, EveryStickLiesInTheSurface) {
  const std::vector<FaultStick> sticks = sticksAlong(GetParam().trace, GetParam().sticks, 5);
  for (const double spacing : {0.0, 37.0, 1e4}) {
    const FaultSurface fault = FaultSurface::loft("fault", sticks, spacing);
    const TriangleBvh bvh(fault.mesh);
    double worst = 0.0;
    for (const FaultStick& stick : sticks)
      for (std::size_t i = 0; i + 1 < stick.points.size(); ++i)
        for (double t = 0.0; t <= 1.0; t += 0.125)
          worst = std::max(
              worst,
              bvh.nearest(stick.points[i] + t * (stick.points[i + 1] - stick.points[i])).distance);
    EXPECT_LT(worst, 1e-9 * 5000.0);
    for (std::size_t t = 0; t < fault.mesh.triangles.size(); ++t)
      EXPECT_GT(test::normalOf(fault.mesh, t).z(), 0.0);
  }
}

INSTANTIATE_TEST_SUITE_P(Traces, Loft,
                         testing::Values(LoftCase{"straight", straight, 2},
                                         LoftCase{"straight", straight, 40},
                                         LoftCase{"arc", arc, 35}, LoftCase{"snake", snake, 60},
                                         LoftCase{"hook", hook, 50}, LoftCase{"many", snake, 300}),
                         [](const auto& it) {
                           return it.param.name + std::to_string(it.param.sticks);
                         });

TEST(LoftInput, SpacingLimitsTheEdgesAlongASquareStrip) {
  const std::vector<FaultStick> sticks = {{{{0, 0, 0}, {0, 0, -100}}},
                                          {{{10, 0, 0}, {10, 0, -100}}}};
  EXPECT_EQ(FaultSurface::loft("coarse", sticks).mesh.triangles.size(), 2U);
  const TriangleMesh fine = FaultSurface::loft("fine", sticks, 10.0).mesh;
  EXPECT_EQ(fine.vertices.size(), 22U);
  EXPECT_EQ(fine.triangles.size(), 20U);
  EXPECT_NEAR(test::areaOf(fine), 1000.0, 1e-9);
  EXPECT_THROW(FaultSurface::loft("far too fine", sticks, 1e-9), InvalidInputError);
  EXPECT_THROW(FaultSurface::loft("negative", sticks, -1.0), InvalidInputError);
}

TEST(LoftInput, DropsRepeatedAndBadPointsAndClosedSticks) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<FaultStick> clean = {
      {{{0, 0, 0}, {0, 0, -9}}}, {{{5, 0, 0}, {5, 0, -9}}}, {{{9, 0, 0}, {9, 0, -9}}}};
  const std::vector<FaultStick> dirty = {
      {{{0, 0, 0}, {0, 0, 0}, {0, 0, -9}, {0, 0, -9.0000000001}}},
      {{{5, 0, 0}, {5, 0, -9}, {5, 0, 0}}}, // drawn down and back up
      {{{nan, 0, 0}}},
      {{{9, 0, -9}, {nan, 1, 1}, {9, 0, 0}}},
      {{{7, 0, 0}, {7, 0, 0}}},
      {}};
  EXPECT_EQ(geometry(FaultSurface::loft("dirty", dirty).mesh),
            geometry(FaultSurface::loft("clean", clean).mesh));
  EXPECT_EQ(orderSticks(dirty).order.size(), 3U);
  EXPECT_THROW(FaultSurface::loft("one", {clean[0]}), InvalidInputError);
  EXPECT_THROW(FaultSurface::loft("none", {}), InvalidInputError);
  EXPECT_THROW(FaultSurface::loft("same", {clean[0], clean[0]}), InvalidInputError);
}

TEST(LoftInput, CoordinatesOfAnySizeAreLoftedOrRefused) {
  for (const double far : {1e100, 1e160, 1e200, 1e300}) {
    std::vector<FaultStick> sticks;
    for (int i = 0; i < 4; ++i)
      sticks.push_back({{{100.0 * i, 0.0, 0.0}, {100.0 * i, i == 2 ? far : 100.0, 300.0}}});
    try {
      FaultSurface::loft("far", sticks);
    } catch (const Error&) {
    }
  }
}

TEST(LoftInput, SticksDrawnOnTimeSlicesRunTheSameWay) {
  for (const bool along_x : {false, true}) {
    std::vector<FaultStick> slices;
    for (int k = 0; k < 6; ++k) {
      // Along y the ends' x tells nothing about which way a stick runs: it sways.
      const double sway = k % 2 == 1 ? 20.0 : -20.0;
      slices.push_back({{{0, 40.0 * k, -50.0 * k},
                         {500, 40.0 * k + 30, -50.0 * k},
                         {1000, 40.0 * k + sway, -50.0 * k}}});
      if (k % 3 == 1)
        std::reverse(slices.back().points.begin(), slices.back().points.end());
      if (!along_x)
        for (Vector3& p : slices.back().points)
          std::swap(p.x(), p.y());
    }
    const TriangleMesh mesh = FaultSurface::loft("slices", slices).mesh;
    expectOneStripWithoutFolds(mesh);
    EXPECT_LT(test::areaOf(mesh), 1.1 * 1000.0 * std::hypot(200.0, 250.0));
  }
}

TEST(LoftInput, TheOrderIsTheShortestPathThroughScatteredSticks) {
  double found_sum = 0.0;
  double best_sum = 0.0;
  for (std::uint64_t seed = 0; seed < 15; ++seed) {
    Random random(seed);
    std::vector<FaultStick> sticks;
    for (int i = 0; i < 8; ++i) {
      const Vector3 top(random.in(0, 1000), random.in(0, 1000), 0);
      sticks.push_back({{top, top - Vector3(0, 0, 500)}});
    }
    const auto lengthOf = [&](const std::vector<std::size_t>& path) {
      double sum = 0.0;
      for (std::size_t i = 0; i + 1 < path.size(); ++i)
        sum += (sticks[path[i]].points[0] - sticks[path[i + 1]].points[0]).norm();
      return sum;
    };
    std::vector<std::size_t> path = {0, 1, 2, 3, 4, 5, 6, 7};
    double best = lengthOf(path);
    while (std::next_permutation(path.begin(), path.end()))
      best = std::min(best, lengthOf(path));
    best_sum += best;
    found_sum += lengthOf(orderSticks(sticks).order);
  }
  EXPECT_LT(found_sum, 1.01 * best_sum);
}
