#include "shapes.h"

#include "graben/analysis/bridges.h"
#include "graben/analysis/triangle_quality.h"
#include "graben/core/errors.h"
#include "graben/mesh/adjacency.h"
#include "graben/mesh/normals.h"
#include "graben/surface/fault_cut.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace graben {
namespace {

struct Extraction {
  double voxel_size = 1.0;
  double rho_plus_delta = 1.5;
  double fault_reach = 6.0;
  std::size_t blend = 1;
  ExtractionOptions extraction;
};

SheetMesh extract(const test::Oriented& o, const FaultNetwork& faults, const Extraction& setup) {
  const NeighborGrid grid(o.points);
  const TangentPlanes planes = o.planes();
  SignedDistanceOptions distance;
  distance.rho_plus_delta = setup.rho_plus_delta;
  distance.overhang = setup.voxel_size;
  distance.fault_reach = setup.fault_reach;
  distance.voxel_size = setup.voxel_size;
  distance.blend = setup.blend;
  ExtractionOptions extraction = setup.extraction;
  extraction.lattice.voxel_size = setup.voxel_size;
  return extractSheets(SignedDistance(grid, planes, faults, distance), extraction);
}

SheetMesh extract(const test::Oriented& o, const Extraction& setup = {}) {
  return extract(o, FaultNetwork(), setup);
}

void expectManifold(const TriangleMesh& mesh) {
  const TopologyReport topology = checkTopology(mesh);
  EXPECT_EQ(topology.non_manifold_edges, 0U);
  EXPECT_EQ(topology.inconsistent_edges, 0U);
  EXPECT_EQ(topology.duplicate_triangles, 0U);
  EXPECT_EQ(topology.degenerate_triangles, 0U);
}

TEST(SheetExtraction, SphereIsClosedAndFacesOut) {
  for (const std::size_t blend : {1U, 4U}) {
    Extraction setup;
    setup.blend = blend;
    const SheetMesh sheets = extract(test::sphere(4000, 10.0, {0.1, 0.2, 0.3}), setup);
    const TopologyReport topology = checkTopology(sheets.mesh);
    EXPECT_TRUE(topology.ok());
    EXPECT_EQ(topology.border_edges, 0U);
    EXPECT_EQ(topology.components, 1U);
    EXPECT_EQ(sheets.mesh.vertices.size() + sheets.mesh.triangles.size() -
                  3 * sheets.mesh.triangles.size() / 2,
              2U)
        << "Euler's number of a sphere";
    for (const Triangle& t : sheets.mesh.triangles) {
      const Vector3 out =
          sheets.mesh.vertices[static_cast<std::size_t>(t[0])] - Vector3(0.1, 0.2, 0.3);
      ASSERT_NEAR(out.norm(), 10.0, 0.1);
      ASSERT_GT(areaNormal(sheets.mesh, t).dot(out), 0.0);
    }
    std::set<std::array<double, 3>> places;
    for (const Vector3& v : sheets.mesh.vertices)
      places.insert({v.x(), v.y(), v.z()});
    EXPECT_EQ(places.size(), sheets.mesh.vertices.size()) << "one vertex per lattice edge";
  }
}

TEST(SheetExtraction, PlanesAreExactWhateverWayTheyDip) {
  for (const Vector3& slope :
       {Vector3(0.0, 0.0, 0.3), Vector3(0.3137, -0.1713, 0.1), Vector3(1.7071, 0.9123, 0.2)}) {
    const auto height = [&](double x, double y) {
      return slope.x() * x + slope.y() * y + slope.z();
    };
    Extraction setup;
    setup.rho_plus_delta = 3.0;
    const SheetMesh sheets = extract(test::sheet(10.0, 0.8, height), setup);
    std::size_t exact = 0;
    for (const Vector3& v : sheets.mesh.vertices) {
      const double off = std::abs(v.z() - height(v.x(), v.y()));
      ASSERT_LE(off, 0.011) << "kept at most a two hundredth of an edge off the lattice vertices";
      exact += off < 1e-9 ? 1 : 0;
    }
    EXPECT_GE(exact, sheets.mesh.vertices.size() * 98 / 100);
    EXPECT_EQ(checkTopology(sheets.mesh).border_loops, 1U);
  }
}

TEST(SheetExtraction, AFlatCloudOnTheLatticeIsNotLost) {
  const SheetMesh sheets = extract(test::sheet(10.0, 1.0, [](double, double) { return 3.0; }));
  ASSERT_FALSE(sheets.mesh.empty());
  for (const Vector3& v : sheets.mesh.vertices)
    ASSERT_NEAR(v.z(), 3.0, 0.006);
  EXPECT_GT(test::areaOf(sheets.mesh), 380.0);
}

TEST(SheetExtraction, HolesWiderThanRhoAllowsStayOpenAndNarrowOnesClose) {
  const test::Oriented all =
      test::sheet(15.0, 0.7, [](double x, double y) { return 0.1 * x + 0.05 * y + 0.2; });
  for (const auto& [radius, loops] : {std::pair{4.0, 2U}, {0.9, 1U}}) {
    test::Oriented o;
    for (std::size_t i = 0; i < all.points.size(); ++i)
      if (all.points[i].head<2>().norm() > radius)
        o.add(all.points[i], all.normals[i]);
    const SheetMesh sheets = extract(o);
    EXPECT_EQ(checkTopology(sheets.mesh).border_loops, loops) << radius;
    const NeighborGrid grid(o.points);
    for (const Vector3& v : sheets.mesh.vertices)
      ASSERT_LE(std::sqrt(grid.nearestOne(v).squared_distance), 1.1)
          << "about a voxel from the data at most";
  }
}

TEST(SheetExtraction, RandomNoisyCloudsAreManifoldAlongEdges) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    test::Random random(seed);
    test::Oriented o;
    for (int i = 0; i < 3000; ++i) {
      const double x = random.uniform(-10.0, 10.0), y = random.uniform(-10.0, 10.0);
      o.add({x, y, random.normal(0.6)}, {random.normal(0.4), random.normal(0.4), 1.0});
    }
    Extraction setup;
    setup.blend = seed % 2 == 0 ? 4 : 1;
    for (const double snap : {0.0, 0.3}) {
      setup.extraction.snap = snap;
      setup.extraction.flip_angle = snap > 0.0 ? 60.0 : 180.0;
      const SheetMesh sheets = extract(o, setup);
      const TopologyReport topology = checkTopology(sheets.mesh);
      EXPECT_GT(sheets.mesh.triangles.size(), 500U);
      if (snap == 0.0) {
        EXPECT_EQ(topology.non_manifold_edges + topology.inconsistent_edges, 0U) << seed;
      }
    }
  }
}

TEST(SheetExtraction, SnappingTakesSliversAway) {
  const test::Oriented o =
      test::sheet(15.0, 0.7, [](double x, double y) { return 0.3 * x - 0.2 * y + 0.013 * x * y; });
  Extraction setup;
  setup.rho_plus_delta = 2.5;
  const TriangleMesh plain = extract(o, setup).mesh;
  setup.extraction.snap = 0.3;
  const TriangleMesh snapped = extract(o, setup).mesh;
  expectManifold(snapped);
  EXPECT_LT(triangleQuality(plain).smallest_angle_p1, 5.0);
  EXPECT_GT(triangleQuality(snapped).smallest_angle_p1, 15.0);
  EXPECT_NEAR(test::areaOf(snapped), test::areaOf(plain), 0.02 * test::areaOf(plain));
}

TEST(SheetExtraction, NeighbouringCloudsAgreeWhereTheyOverlap) {
  const auto height = [](double x, double y) { return 0.5 * std::sin(0.4 * x) + 0.1 * y + 0.3; };
  const test::Oriented all = test::sheet(12.0, 0.7, height);
  test::Oriented west;
  for (std::size_t i = 0; i < all.points.size(); ++i)
    if (all.points[i].x() < 4.0)
      west.points.push_back(all.points[i]), west.normals.push_back(all.normals[i]);
  std::set<std::array<double, 3>> places;
  for (const Vector3& v : extract(all).mesh.vertices)
    places.insert({v.x(), v.y(), v.z()});
  std::size_t compared = 0;
  for (const Vector3& v : extract(west).mesh.vertices)
    if (v.x() < 1.0) {
      ASSERT_EQ(places.count({v.x(), v.y(), v.z()}), 1U) << "the same vertex, to the bit";
      ++compared;
    }
  EXPECT_GT(compared, 300U);
}

/// Two level blocks with throw 4 at a fault dipping 60 degrees to the east; east of the fault is
/// down.
test::Oriented thrown(double half) {
  test::Oriented o;
  const test::Oriented all = test::sheet(half, 0.7, [](double, double) { return 0.0; });
  for (const Vector3& p : all.points)
    for (const double z : {2.13, -1.87})
      if ((z > 0.0) == (p.x() < z / std::tan(test::kPi / 3.0)))
        o.add({p.x(), p.y(), z}, Vector3::UnitZ());
  return o;
}

TEST(SheetExtraction, NoBridgeAtAFaultWithThrow) {
  const FaultNetwork faults({test::dippingFault(-30.0, 30.0, 20.0)});
  const test::Oriented o = thrown(12.0);
  const SheetMesh sheets = extract(o, faults, {});
  ASSERT_EQ(sheets.home.size(), sheets.mesh.triangles.size());
  EXPECT_EQ(checkTopology(sheets.mesh).non_manifold_edges, 0U);
  const CutMesh cut = cutSheets(sheets, faults, {0.01, 0});
  const TopologyReport topology = checkTopology(cut.mesh);
  EXPECT_TRUE(topology.ok());
  EXPECT_EQ(topology.components, 2U);
  EXPECT_TRUE(bridgingTriangles(cut.mesh, faults, 1e-6).empty());
  for (const Vector3& v : cut.mesh.vertices) {
    ASSERT_NEAR(std::abs(v.z() - 0.13), 2.0, 0.006);
    const double beyond = (v.z() > 0.0 ? 1.0 : -1.0) * (v.x() - v.z() / std::tan(test::kPi / 3.0));
    ASSERT_LT(beyond, 1e-6) << "each sheet ends at the fault";
  }
  std::array<double, 2> reach = {0.0, 0.0}; // length of cutoff on each side
  for (const Triangle& t : cut.mesh.triangles)
    for (std::size_t e = 0; e < 3; ++e)
      if (cut.onFault(t[e]) && cut.onFault(t[(e + 1) % 3])) {
        const Vector3& a = cut.mesh.vertices[static_cast<std::size_t>(t[e])];
        reach[a.z() > 0.0 ? 0 : 1] +=
            (cut.mesh.vertices[static_cast<std::size_t>(t[(e + 1) % 3])] - a).norm();
      }
  EXPECT_GT(reach[0], 21.0) << "sealed along its whole length, but for the corners of the area";
  EXPECT_GT(reach[1], 21.0);
}

TEST(SheetExtraction, WithoutTheFaultTheSameCloudGivesACurtain) {
  const FaultNetwork faults({test::dippingFault(-30.0, 30.0, 20.0)});
  Extraction setup;
  setup.rho_plus_delta = 5.0;
  setup.extraction.flip_angle = 180.0;
  const SheetMesh sheets = extract(thrown(12.0), setup);
  EXPECT_FALSE(bridgingTriangles(sheets.mesh, faults, 1e-6).empty());
}

TEST(SheetExtraction, OnePieceRoundATip) {
  // The displacement dies out towards the fault's end at y = 0.
  const auto fall = [](double y) { return y < 0.0 ? 1.5 * std::min(1.0, y * y / 36.0) : 0.0; };
  const auto height = [&](double x, double y) { return (x < 0.0 ? 1.0 : -1.0) * fall(y) + 0.23; };
  test::Oriented o;
  const test::Oriented all = test::sheet(15.0, 0.6, [](double, double) { return 0.0; });
  for (const Vector3& p : all.points)
    o.add({p.x(), p.y(), height(p.x(), p.y())}, Vector3::UnitZ());
  const FaultNetwork faults({test::dippingFault(-30.0, 0.0, 20.0, 90.0)});
  Extraction setup;
  setup.voxel_size = 0.8;
  setup.rho_plus_delta = 1.2;
  const CutMesh cut = cutSheets(extract(o, faults, setup), faults, {0.01, 0});
  const TopologyReport topology = checkTopology(cut.mesh);
  EXPECT_TRUE(topology.ok());
  EXPECT_EQ(topology.components, 1U);
  EXPECT_EQ(topology.border_loops, 1U)
      << "the cut runs in from the border and no hole is left at the tip";
  EXPECT_TRUE(bridgingTriangles(cut.mesh, faults, 1e-6).empty());
}

TEST(SheetExtraction, FlipAngleLeavesOutOnlyTrianglesThatTurnAgainstTheSurface) {
  const test::Oriented smooth =
      test::sheet(12.0, 0.7, [](double x, double y) { return std::sin(0.2 * x) + 0.1 * y; });
  Extraction setup;
  setup.extraction.flip_angle = 60.0;
  EXPECT_EQ(extract(smooth, setup).rejected_by_flip_angle, 0U);
  setup.rho_plus_delta = 5.0;
  EXPECT_GT(extract(thrown(12.0), setup).rejected_by_flip_angle, 20U);
  setup.extraction.flip_angle = 180.0;
  EXPECT_EQ(extract(thrown(12.0), setup).rejected_by_flip_angle, 0U);
}

TEST(SheetExtraction, ImpossibleSizesAreRefused) {
  const test::Oriented o = test::sheet(12.0, 0.7, [](double, double) { return 0.2; });
  Extraction setup;
  for (const double h : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    setup.voxel_size = h;
    EXPECT_THROW(extract(o, setup), InvalidInputError);
  }
  setup.voxel_size = 1e-6;
  EXPECT_THROW(extract(o, setup), ResourceError);
  setup.voxel_size = 0.5;
  setup.extraction.memory_limit = 10000;
  EXPECT_THROW(extract(o, setup), ResourceError);
}

TEST(SheetExtraction, AVoxelSizeThatDoesNotFitIsRefusedAtOnceAndTheOneNamedInsteadFits) {
  const test::Oriented o = test::sheet(12.0, 0.7, [](double x, double) { return 0.2 * std::sin(x); });
  for (const auto& [voxel_size, limit] : {std::pair{1e-7, 0.0}, {0.002, 1e9}, {0.3, 2e6}}) {
    Extraction setup;
    setup.voxel_size = voxel_size;
    setup.extraction.memory_limit = static_cast<std::size_t>(limit);
    std::string message;
    try {
      extract(o, setup); // would run for hours if it were not refused
    } catch (const ResourceError& error) {
      message = error.what();
    }
    const std::string before = "a voxel size of ";
    ASSERT_NE(message.find(before), std::string::npos) << voxel_size << message;
    setup.voxel_size = std::stod(message.substr(message.find(before) + before.size()));
    EXPECT_GT(setup.voxel_size, voxel_size);
    if (limit > 0.0 && limit < 1e8)
      EXPECT_GT(extract(o, setup).mesh.triangles.size(), 100U);
    else
      EXPECT_NO_THROW(checkVoxelSize(NeighborGrid(o.points), {setup.voxel_size, Vector3::Zero()}, setup.rho_plus_delta,
                                     setup.extraction.memory_limit));
  }
}

TEST(SheetExtraction, ThreadsMakeNoDifference) {
  const FaultNetwork faults({test::dippingFault(-30.0, 4.0, 20.0)});
  Extraction setup;
  setup.extraction.snap = 0.3;
  setup.blend = 4;
  setup.extraction.threads = 1;
  const SheetMesh one = extract(thrown(12.0), faults, setup);
  setup.extraction.threads = 4;
  const SheetMesh four = extract(thrown(12.0), faults, setup);
  EXPECT_TRUE(test::sameMesh(one.mesh, four.mesh));
  EXPECT_EQ(one.home, four.home);
}

} // namespace
} // namespace graben
