#include "graben/faults/fault_lofting.h"

#include "graben/core/errors.h"
#include "graben/faults/fault_network.h"
#include "graben/mesh/adjacency.h"
#include "graben/mesh/triangle_bvh.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <ostream>
#include <string>

using namespace graben;
using test::Random;

namespace {

constexpr double kRadian = M_PI / 180.0;

/// A fault of 60 degrees, 3200 long and 700 high, turned and moved, plane or with a bend along strike and down dip.
struct TrueFault {
  double azimuth = 0.0, dip = 60.0, bend = 0.0, listric = 0.0;
  Vector3 origin = Vector3::Zero();

  Vector3 at(double along, double z) const {
    const double depth = -1700.0 - z;
    const double off = depth / std::tan(dip * kRadian) + bend * std::sin(along / 900.0) + listric * depth * depth;
    return origin + off * across() + along * Vector3(-across().y(), across().x(), 0.0) + z * Vector3::UnitZ();
  }

  Vector3 across() const { return {std::cos(azimuth * kRadian), -std::sin(azimuth * kRadian), 0.0}; }

  /// Nodes off by \a noise (standard deviation) across the fault and \a level of it along strike.
  std::vector<FaultStick> sticks(double apart, double noise = 0.0, double level = 0.0) const {
    Random random(1);
    const Vector3 strike(-across().y(), across().x(), 0.0);
    std::vector<FaultStick> result;
    const double count = std::round(1600.0 / apart);
    for (double i = -count; i <= count; i += 1.0) {
      result.emplace_back();
      for (const double z : {-1700.0, -1850.0, -2000.0, -2150.0, -2300.0})
        result.back().points.push_back(at(apart * i, z) + noise * (random.in(-1.73, 1.73) * across() + level * random.in(-1.73, 1.73) * strike));
    }
    return result;
  }

  friend void PrintTo(const TrueFault& fault, std::ostream* out) {
    *out << "azimuth " << fault.azimuth << ", dip " << fault.dip << ", bend " << fault.bend << ", listric " << fault.listric;
  }

  /// Largest distance of a surface to where the fault is, over its inner part.
  double worst(const FaultSurface& surface) const {
    const TriangleBvh bvh(surface.mesh);
    double worst = 0.0;
    for (double along = -1300.0; along <= 1300.0; along += 100.0)
      for (double z = -2200.0; z <= -1800.0; z += 100.0)
        worst = std::max(worst, bvh.nearest(at(along, z)).distance);
    return worst;
  }
};

FaultSurface only(const LoftedFaults& lofted) {
  EXPECT_EQ(lofted.faults.size(), 1U);
  return lofted.faults.front();
}

TriangleMesh meshOf(const TrueFault& fault, double top, double bottom, double shift = 0.0) {
  TriangleMesh mesh;
  for (int i = 0; i <= 16; ++i)
    for (int k = 0; k <= 4; ++k)
      mesh.vertices.push_back(fault.at(-1600.0 + 200.0 * i, top + (bottom - top) * k / 4.0) + shift * fault.across());
  for (Index i = 0; i < 16; ++i)
    for (Index k = 0; k < 4; ++k) {
      const Index a = 5 * i + k;
      mesh.triangles.push_back({a, a + 1, a + 5});
      mesh.triangles.push_back({a + 5, a + 1, a + 6});
    }
  return mesh;
}

class Digitised : public testing::TestWithParam<TrueFault> {};

std::string messageOf(const std::function<void()>& run) {
  try {
    run();
  } catch (const InvalidInputError& error) {
    return error.what();
  }
  return "";
}

} // namespace

TEST_P(Digitised, CleanSticksAreTakenAsTheyAre) {
  const std::vector<FaultStick> sticks = GetParam().sticks(200.0);
  const LoftedFaults lofted = loftFaults("f", sticks);
  EXPECT_TRUE(lofted.notes.empty());
  EXPECT_TRUE(lofted.warnings.empty());
  EXPECT_EQ(only(lofted).mesh.vertices, FaultSurface::loft("f", sticks).mesh.vertices);
}

TEST_P(Digitised, NodesOutOfOrderArePutInOrder) {
  std::vector<FaultStick> sticks = GetParam().sticks(200.0);
  const FaultSurface clean = FaultSurface::loft("f", sticks);
  for (std::size_t i = 0; i < sticks.size(); i += 2)
    std::swap(sticks[i].points[1], sticks[i].points[3]);
  const LoftedFaults lofted = loftFaults("f", sticks);
  ASSERT_EQ(lofted.notes.size(), 1U);
  EXPECT_NE(lofted.notes[0].find("put in order"), std::string::npos);
  EXPECT_EQ(only(lofted).mesh.vertices, clean.mesh.vertices);
}

TEST_P(Digitised, AFlyerIsSetAsideAndSaid) {
  for (const Vector3& jump : {Vector3(0, 0, 1800), Vector3(900.0 * GetParam().across()), Vector3(-300.0 * GetParam().across())})
    for (const std::size_t node : {std::size_t{0}, std::size_t{2}}) {
      std::vector<FaultStick> sticks = GetParam().sticks(200.0);
      sticks[5].points[node] += jump;
      const LoftedFaults lofted = loftFaults("f", sticks);
      ASSERT_EQ(lofted.warnings.size(), 1U) << jump.transpose();
      EXPECT_NE(lofted.warnings[0].find("node " + std::to_string(node + 1) + " of stick 6"), std::string::npos) << lofted.warnings[0];
      EXPECT_LT(GetParam().worst(only(lofted)), node == 0 ? 60.0 : 15.0); // without its end a stick leaves a notch
    }
}

TEST_P(Digitised, NoisySticksBecomeASmoothSurface) {
  for (const double level : {0.0, 1.0}) {
    const std::vector<FaultStick> sticks = GetParam().sticks(12.5, 15.0, level);
    const LoftedFaults lofted = loftFaults("f", sticks);
    EXPECT_LT(GetParam().worst(only(lofted)), 12.0);
    ASSERT_EQ(lofted.notes.size(), 1U);
    EXPECT_NE(lofted.notes[0].find("standard deviation"), std::string::npos);
    EXPECT_TRUE(lofted.warnings.empty());
  }
  const std::vector<FaultStick> sticks = GetParam().sticks(12.5, 15.0);
  LoftOptions exact;
  exact.smoothing = 0.0;
  const LoftedFaults kept = loftFaults("f", sticks, exact);
  ASSERT_EQ(kept.warnings.size(), 1U);
  EXPECT_NE(kept.warnings[0].find("folds over itself"), std::string::npos);
  LoftOptions given;
  given.smoothing = 14.0;
  EXPECT_LT(GetParam().worst(only(loftFaults("f", sticks, given))), 20.0);
}

TEST_P(Digitised, SticksAcrossEachOtherMakeOneSurface) {
  std::vector<FaultStick> sticks = GetParam().sticks(300.0);
  for (const double z : {-1900.0, -2100.0}) {
    sticks.emplace_back();
    for (double along = -1600.0; along <= 1600.0; along += 200.0)
      sticks.back().points.push_back(GetParam().at(along, z));
  }
  const LoftedFaults lofted = loftFaults("f", sticks);
  EXPECT_LT(GetParam().worst(only(lofted)), 5.0);
  EXPECT_EQ(lofted.notes.size(), 1U);
}

TEST_P(Digitised, PointsWithoutSticksMakeASurface) {
  Random random(7);
  TriangleMesh cloud;
  for (int i = 0; i < 600; ++i)
    cloud.vertices.push_back(GetParam().at(random.in(-1600.0, 1600.0), random.in(-2300.0, -1700.0)));
  const FaultSurface from_cloud = only(meshedFault("f", cloud));
  EXPECT_LT(GetParam().worst(from_cloud), 8.0);
  const FaultSurface from_line = only(loftFaults("f", {{cloud.vertices}}));
  EXPECT_EQ(from_line.mesh.vertices.size(), from_cloud.mesh.vertices.size());
  EXPECT_LT(GetParam().worst(from_line), 8.0);
}

TEST_P(Digitised, AClosedThinVolumeIsReducedToItsMiddle) {
  const TrueFault& fault = GetParam();
  TriangleMesh box = meshOf(fault, -1700.0, -2300.0, -20.0);
  const TriangleMesh other = meshOf(fault, -1700.0, -2300.0, 20.0);
  const auto far = static_cast<Index>(box.vertices.size());
  const EdgeAdjacency adjacency(box);
  const TriangleMesh near = box;
  box.vertices.insert(box.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const Triangle& t : other.triangles)
    box.triangles.push_back({t[0] + far, t[2] + far, t[1] + far});
  for (std::size_t h = 0; h < 3 * near.triangles.size(); ++h)
    if (adjacency.isBorder(static_cast<Index>(h))) {
      const Index a = near.triangles[h / 3][h % 3];
      const Index next = near.triangles[h / 3][(h % 3 + 1) % 3];
      box.triangles.push_back({next, a, a + far});
      box.triangles.push_back({next, a + far, next + far});
    }
  const LoftedFaults lofted = meshedFault("f", box);
  ASSERT_EQ(lofted.warnings.size(), 1U);
  EXPECT_NE(lofted.warnings[0].find("closed"), std::string::npos);
  EXPECT_LT(fault.worst(only(lofted)), 6.0);
}

/// Each triangle by itself, its corners off by up to \a off.
TriangleMesh loosened(const TriangleMesh& mesh, double off) {
  Random random(9);
  TriangleMesh loose;
  for (const Triangle& t : mesh.triangles) {
    const auto first = static_cast<Index>(loose.vertices.size());
    for (const Index v : t)
      loose.vertices.push_back(mesh.vertices[static_cast<std::size_t>(v)] + random.point(off));
    loose.triangles.push_back({first, first + 1, first + 2});
  }
  return loose;
}

TEST_P(Digitised, LooseTrianglesMakeOneSurfaceWhereTheyAreOne) {
  const TriangleMesh mesh = meshOf(GetParam(), -1700.0, -2300.0);
  ASSERT_GT(mesh.triangles.size(), 50U);
  const LoftedFaults lofted = meshedFault("f", loosened(mesh, 3.0));
  ASSERT_EQ(lofted.warnings.size(), 1U);
  EXPECT_NE(lofted.warnings[0].find("lie loose"), std::string::npos);
  EXPECT_LT(GetParam().worst(only(lofted)), 12.0);
  EXPECT_NE(messageOf([&] { meshedFault("f", loosened(mesh, 900.0)); }).find("It is no surface: its triangles lie loose"), std::string::npos);
}

TEST_P(Digitised, PatchesOneAboveTheOtherSeparateAsOne) {
  const TrueFault& fault = GetParam();
  for (const double gap : {20.0, -20.0}) {
    TriangleMesh mesh = meshOf(fault, -1700.0, -2000.0);
    append(mesh, meshOf(fault, -2000.0 - gap, -2300.0, 4.0));
    const LoftedFaults lofted = meshedFault("f", mesh);
    ASSERT_EQ(lofted.notes.size(), 1U) << gap;
    const FaultSurface joined = only(lofted);
    EXPECT_LT(fault.worst(joined), 8.0);
    const FaultNetwork network({joined});
    const Vector3 off = 60.0 * (fault.at(1.0, -2000.0) - fault.at(0.0, -2000.0)).cross(Vector3::UnitZ());
    for (double z = -2200.0; z < -1800.0; z += 7.0)
      EXPECT_TRUE(network.separates(0, fault.at(130.0, z) + off, fault.at(130.0, z) - off)) << z;
  }
}

std::string nameOfTrueFault(const testing::TestParamInfo<TrueFault>& tested) {
  const char* const names[] = {"Plane", "Bent", "Steep", "Listric", "InMapCoordinates"}; // in the order below
  return names[tested.index];
}

INSTANTIATE_TEST_SUITE_P(Faults, Digitised,
                         testing::Values(TrueFault{}, TrueFault{37.0, 60.0, 60.0}, TrueFault{-120.0, 85.0, 30.0},
                                         TrueFault{200.0, 75.0, 0.0, 0.0008}, TrueFault{90.0, 45.0, 40.0, 0.0, {461000.0, 5931000.0, 0.0}}),
                         nameOfTrueFault);

TEST(FaultLofting, FaultsInOneFileAreToldApart) {
  TrueFault west;
  for (const double apart : {150.0, 500.0, 1200.0}) {
    TrueFault east = west;
    east.origin = Vector3(apart, 0.0, 0.0);
    for (const double step : {100.0, 300.0}) {
      std::vector<FaultStick> sticks = west.sticks(step);
      for (const FaultStick& stick : east.sticks(step))
        sticks.insert(sticks.begin() + static_cast<std::ptrdiff_t>(sticks.size() / 2), stick);
      const LoftedFaults lofted = loftFaults("f", sticks);
      ASSERT_EQ(lofted.faults.size(), 2U) << apart << " " << step;
      EXPECT_EQ(lofted.faults[0].name, "f_1");
      EXPECT_EQ(lofted.notes.size(), 1U);
      const bool swapped = west.worst(lofted.faults[0]) > 1.0;
      EXPECT_LT(west.worst(lofted.faults[swapped ? 1 : 0]), 1e-6);
      EXPECT_LT(east.worst(lofted.faults[swapped ? 0 : 1]), 1e-6);
    }
  }
}

TEST(FaultLofting, RingsAndTracesAreRefusedWithTheReason) {
  std::vector<FaultStick> rings(2);
  std::vector<FaultStick> traces(2);
  for (std::size_t f = 0; f < 2; ++f) {
    const double x = 1200.0 * static_cast<double>(f);
    const double z = -2000.0 - 100.0 * static_cast<double>(f);
    for (double y = -1600.0; y <= 1600.0; y += 200.0) {
      rings[f].points.emplace_back(x - 30.0, y, z);
      traces[f].points.emplace_back(x, y, z - 50.0);
    }
    for (double y = 1600.0; y >= -1600.0; y -= 200.0)
      rings[f].points.emplace_back(x + 30.0, y, z - 100.0);
    rings[f].points.push_back(rings[f].points.front());
  }
  EXPECT_NE(messageOf([&] { loftFaults("f", rings); }).find("closed rings"), std::string::npos);
  EXPECT_NE(messageOf([&] { loftFaults("f", traces); }).find("traces of several faults"), std::string::npos);
  EXPECT_NE(messageOf([&] { loftFaults("f", {traces[0]}); }).find("--fault-dip"), std::string::npos);
}

TEST(FaultLofting, ATraceGoesDownAsItIsTold) {
  std::vector<FaultStick> traces(2);
  for (double y = -1600.0; y <= 1600.0; y += 200.0) {
    traces[0].points.emplace_back(0.0, y, -2050.0);
    traces[1].points.emplace_back(1200.0, y, -2150.0);
  }
  LoftOptions options;
  options.horizon.extend(Vector3(-2000.0, -2000.0, -2300.0));
  options.horizon.extend(Vector3(2000.0, 2000.0, -1900.0));
  options.trace_dip = TraceDip{60.0, 110.0};
  const LoftedFaults lofted = loftFaults("f", traces, options);
  ASSERT_EQ(lofted.faults.size(), 2U);
  const double run = 250.0 / std::tan(60.0 * kRadian);
  EXPECT_LT(TriangleBvh(lofted.faults[0].mesh).nearest({run, 30.0, -2300.0}).distance, 1e-6);
  EXPECT_LT(TriangleBvh(lofted.faults[0].mesh).nearest({-150.0 / 250.0 * run, 30.0, -1900.0}).distance, 1e-6);
  options.trace_dip = TraceDip{};
  EXPECT_LT(TriangleBvh(loftFaults("f", traces, options).faults[1].mesh).nearest({1200.0, 30.0, -2300.0}).distance, 1e-6);
  options.trace_dip = TraceDip{60.0, std::nullopt};
  EXPECT_NE(messageOf([&] { loftFaults("f", traces, options); }).find("which way"), std::string::npos);
}

TEST(FaultLofting, SticksAlongStrikeHaveTheirTipsAtTheirEnds) {
  const TrueFault fault;
  std::vector<FaultStick> sticks(2);
  for (double along = -1600.0; along <= 1600.0; along += 200.0)
    for (std::size_t k = 0; k < 2; ++k)
      sticks[k].points.push_back(fault.at(along, k == 0 ? -1970.0 : -2130.0));
  const FaultSurface surface = only(loftFaults("f", sticks));
  for (const Points& line : surface.tip_lines) {
    ASSERT_EQ(line.size(), 2U);
    EXPECT_NEAR(std::abs(line[0].y()), 1600.0, 1e-9);
    EXPECT_NEAR(std::abs(line[1].y()), 1600.0, 1e-9);
  }
}

TEST(FaultLofting, AThickClosedVolumeIsRefused) {
  TriangleMesh cube;
  for (int i = 0; i < 8; ++i)
    cube.vertices.emplace_back(100.0 * (i & 1), 50.0 * (i & 2), 25.0 * (i & 4));
  cube.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4}, {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  EXPECT_NE(messageOf([&] { meshedFault("f", cube); }).find("closed"), std::string::npos);
}
