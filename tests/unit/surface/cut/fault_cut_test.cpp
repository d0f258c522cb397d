#include "shapes.h"

#include "graben/analysis/bridges.h"
#include "graben/mesh/adjacency.h"
#include "graben/mesh/normals.h"
#include "graben/surface/crumbs.h"
#include "graben/surface/fault_cut.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <random>

namespace graben {
namespace {

/// A wavy mesh of 30 x 30 cells over [-15, 15]^2.
TriangleMesh wavy() {
  TriangleMesh mesh = test::flatGrid(30, 1.0);
  for (Vector3& v : mesh.vertices)
    v.z() = 0.8 * std::sin(0.3 * v.x()) * std::cos(0.2 * v.y());
  return mesh;
}

/// A vertical fault along a line in x, y.
FaultSurface wall(const char* name, const Vector3& a, const Vector3& b) {
  const Vector3 up(0.0, 0.0, 10.0);
  TriangleMesh mesh;
  mesh.vertices = {a - up, b - up, b + up, a + up};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return FaultSurface::fromMesh(name, mesh);
}

/// Every cut vertex lies on its faults, and the cut mesh has the area it had.
void expectExact(const CutMesh& cut, const TriangleMesh& before, const FaultNetwork& faults) {
  ASSERT_EQ(cut.vertex_faults.size(), cut.mesh.vertices.size());
  EXPECT_TRUE(checkTopology(cut.mesh).ok());
  EXPECT_NEAR(test::areaOf(cut.mesh), test::areaOf(before), 1e-3);
  EXPECT_TRUE(bridgingTriangles(cut.mesh, faults, 1e-6).empty());
  for (std::size_t v = 0; v < cut.mesh.vertices.size(); ++v)
    for (const Index f : cut.vertex_faults[v])
      if (f >= 0) {
        EXPECT_LT(faults.nearest(static_cast<std::size_t>(f), cut.mesh.vertices[v]).distance, 1e-9);
      }
}

/// How many vertices stand at each place of vertices on faults.
std::map<std::array<double, 3>, int> standing(const CutMesh& cut) {
  std::map<std::array<double, 3>, int> count;
  for (std::size_t v = 0; v < cut.mesh.vertices.size(); ++v)
    if (cut.onFault(static_cast<Index>(v)))
      ++count[{cut.mesh.vertices[v].x(), cut.mesh.vertices[v].y(), cut.mesh.vertices[v].z()}];
  return count;
}

/// The lowest corner of the fan of each corner.
std::vector<std::size_t> fansByFlooding(const TriangleMesh& mesh) {
  const EdgeAdjacency adjacency(mesh);
  std::vector<std::size_t> fan(3 * mesh.triangles.size());
  std::iota(fan.begin(), fan.end(), std::size_t{0});
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t edge = 0; edge < fan.size(); ++edge) {
      const Index twin = adjacency.twin(static_cast<Index>(edge));
      if (twin < 0)
        continue;
      const auto other = static_cast<std::size_t>(twin); // it starts where the edge ends
      const auto after = [](std::size_t c) { return c % 3 == 2 ? c - 2 : c + 1; };
      for (const auto& [c, d] : {std::make_pair(edge, after(other)), std::make_pair(after(edge), other)})
        if (fan[c] != fan[d]) {
          fan[c] = fan[d] = std::min(fan[c], fan[d]);
          changed = true;
        }
    }
  }
  return fan;
}

TEST(FaultCut, ThroughTheMeshDoublesEveryVertexOnTheFault) {
  const FaultNetwork faults({test::dippingFault(-30.0, 30.0, 10.0, 60.0, 0.37)});
  const CutMesh cut = cutAlongFaults(wavy(), faults, {});
  expectExact(cut, wavy(), faults);
  EXPECT_EQ(checkTopology(cut.mesh).components, 2U);
  const auto places = standing(cut);
  EXPECT_GT(places.size(), 50U);
  for (const auto& place : places)
    EXPECT_EQ(place.second, 2);
}

TEST(FaultCut, AlongEdgesAndThroughVerticesMakesNoNewTriangle) {
  for (const auto& [a, b] : {std::pair{Vector3(0, -20, 0), Vector3(0, 20, 0)},
                             {Vector3(-20, -20, 0), Vector3(20, 20, 0)}}) {
    const FaultNetwork faults({wall("wall", a, b)});
    const TriangleMesh before = test::flatGrid(30, 1.0);
    const CutMesh cut = cutAlongFaults(before, faults, {});
    expectExact(cut, before, faults);
    EXPECT_EQ(cut.mesh.triangles.size(), before.triangles.size());
    EXPECT_EQ(cut.mesh.vertices.size(), before.vertices.size() + 31);
    EXPECT_EQ(checkTopology(cut.mesh).components, 2U);
  }
}

TEST(FaultCut, EndsInsideWhereTheFaultDoes) {
  const double south = -6.3, north = 4.7;
  const FaultNetwork faults({wall("short", {0.21, south, 0}, {0.21, north, 0})});
  const CutMesh cut = cutAlongFaults(wavy(), faults, {});
  expectExact(cut, wavy(), faults);
  const TopologyReport topology = checkTopology(cut.mesh);
  EXPECT_EQ(topology.components, 1U);
  EXPECT_EQ(topology.border_loops, 2U) << "the outer border and the slit";
  double low = 100.0, high = -100.0;
  for (const auto& [place, count] : standing(cut)) {
    low = std::min(low, place[1]);
    high = std::max(high, place[1]);
    EXPECT_EQ(count, place[1] > south + 1e-9 && place[1] < north - 1e-9 ? 2 : 1);
  }
  EXPECT_NEAR(low, south, 1e-9);
  EXPECT_NEAR(high, north, 1e-9);
}

TEST(FaultCut, EndsBetweenACornerOnTheFaultAndTheOppositeEdge) {
  const Vector3 tip(2.2, 1.1, 0.0); // inside a triangle at the vertex (2, 1), through which the fault comes
  const FaultNetwork faults({wall("short", -20.0 * tip, tip)});
  const TriangleMesh before = test::flatGrid(30, 1.0);
  const CutMesh cut = cutAlongFaults(before, faults, {});
  expectExact(cut, before, faults);
  double farthest = 0.0;
  for (const auto& place : standing(cut))
    farthest = std::max(farthest, place.first[0]);
  EXPECT_NEAR(farthest, tip.x(), 1e-9);
}

TEST(FaultCut, ATipOnACutEdgeEndsTheCutThereAndLeavesNoEmptyTriangle) {
  const TriangleMesh before = test::flatGrid(30, 1.0);
  for (const double x : {2.5, 2.3, 2.75}) {
    const FaultNetwork faults({wall("short", {2.1, -20.0, 0.0}, {x, 1.0, 0.0})});
    const CutMesh cut = cutAlongFaults(before, faults, {});
    expectExact(cut, before, faults);
    for (const Triangle& t : cut.mesh.triangles)
      ASSERT_GT(areaNormal(cut.mesh, t).norm(), 1e-3);
    double farthest = 0.0;
    for (const auto& place : standing(cut))
      farthest = std::max(farthest, place.first[1]);
    EXPECT_NEAR(farthest, 1.0, 1e-9) << "the cut reaches the tip";
  }
}

TEST(FaultCut, ABranchMakesThreePiecesThatMeetOnItsLine) {
  const FaultNetwork faults(
      {wall("main", {0.3, -20, 0}, {0.3, 20, 0}), wall("branch", {0.3, 1.4, 0}, {20, 9.4, 0})},
      0.5);
  const CutMesh cut = cutAlongFaults(wavy(), faults, {});
  expectExact(cut, wavy(), faults);
  EXPECT_EQ(checkTopology(cut.mesh).components, 3U);
  EXPECT_TRUE(std::any_of(cut.vertex_faults.begin(), cut.vertex_faults.end(), [](const auto& f) {
    return f[0] == 0 && f[1] == 1;
  })) << "the corner where the pieces meet is on both faults";
}

TEST(FaultCut, CrossingFaultsMakeFourPieces) {
  const FaultNetwork faults(
      {wall("a", {0.3, -20, 0}, {1.1, 20, 0}), wall("b", {-20, -3.2, 0}, {20, 4.1, 0})});
  const CutMesh cut = cutAlongFaults(wavy(), faults, {});
  expectExact(cut, wavy(), faults);
  EXPECT_EQ(checkTopology(cut.mesh).components, 4U);
  std::size_t corners = 0;
  for (const auto& on : cut.vertex_faults)
    corners += on[1] >= 0 ? 1 : 0;
  EXPECT_EQ(corners, 4U) << "one corner for each piece";
}

TEST(FaultCut, ManyPlacesOfAFaultGiveTheSameArea) {
  test::Random random(3);
  for (int i = 0; i < 40; ++i) {
    const double angle = random.uniform(0.0, 2.0 * test::kPi);
    const Vector3 way(std::cos(angle), std::sin(angle), 0.0),
        at(random.uniform(-8.0, 8.0), random.uniform(-8.0, 8.0), 0.0);
    const FaultNetwork faults({wall("wall", at - 60.0 * way, at + 60.0 * way),
                               wall("short", at + Vector3(1.5, 0.1, 0.0),
                                    at + Vector3(random.uniform(2.0, 6.0), 2.0, 0.0))});
    const CutMesh cut = cutAlongFaults(wavy(), faults, {});
    SCOPED_TRACE(i);
    EXPECT_EQ(checkTopology(cut.mesh).components, 2U);
    EXPECT_TRUE(checkTopology(cut.mesh).ok());
    EXPECT_NEAR(test::areaOf(cut.mesh), test::areaOf(wavy()), 0.05)
        << "but for what snapping within a fiftieth of an edge moves";
  }
}

TEST(FaultCut, AFaultThatMissesChangesNothing) {
  const FaultNetwork faults(
      {wall("far", {100, -20, 0}, {100, 20, 0}), test::dippingFault(-30, 30, 5.0, 45.0, 50.0)});
  const TriangleMesh before = wavy();
  EXPECT_TRUE(test::sameMesh(cutAlongFaults(before, faults, {}).mesh, before));
  EXPECT_TRUE(test::sameMesh(cutAlongFaults(before, FaultNetwork(), {}).mesh, before));
}

TEST(FaultCut, PerVertexArraysAreInterpolated) {
  TriangleMesh mesh = wavy();
  for (const Vector3& v : mesh.vertices) {
    mesh.normals.push_back(Vector3::UnitZ());
    mesh.piece.push_back(4);
    mesh.scalars["x"].push_back(static_cast<float>(v.x()));
  }
  const FaultNetwork faults({test::dippingFault(-30.0, 3.2, 10.0, 60.0, 0.37)});
  const CutMesh cut = cutAlongFaults(mesh, faults, {1e-6, 0});
  ASSERT_EQ(cut.mesh.scalars.at("x").size(), cut.mesh.vertices.size());
  for (std::size_t v = 0; v < cut.mesh.vertices.size(); ++v) {
    EXPECT_EQ(cut.mesh.piece[v], 4);
    EXPECT_NEAR(cut.mesh.normals[v].z(), 1.0, 1e-12);
    EXPECT_NEAR(static_cast<double>(cut.mesh.scalars.at("x")[v]), cut.mesh.vertices[v].x(),
                0.5 + 1e-5);
  }
}

TEST(FaultCut, FansThatShareOnlyAVertexAreParted) {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 3, 4}};
  const CutMesh cut = cutAlongFaults(mesh, FaultNetwork(), {});
  EXPECT_EQ(cut.mesh.vertices.size(), 6U);
  EXPECT_EQ(checkTopology(cut.mesh).components, 2U);
}

TEST(FaultCut, FansAreThoseOfTheEdgesThatTwoTrianglesShare) {
  std::mt19937 generator(3);
  for (int round = 0; round < 300; ++round) {
    TriangleMesh mesh;
    for (int v = 0; v < 7; ++v)
      mesh.vertices.emplace_back(v, v % 3, v % 2);
    for (int t = 0; t < 3 + round % 12; ++t)
      mesh.triangles.push_back({static_cast<Index>(generator() % 7), static_cast<Index>(generator() % 7), static_cast<Index>(generator() % 7)});
    const std::vector<std::size_t> fan = fansByFlooding(mesh);
    const TriangleMesh cut = cutAlongFaults(mesh, FaultNetwork(), {}).mesh;
    ASSERT_EQ(cut.triangles.size(), mesh.triangles.size());
    for (std::size_t c = 0; c < fan.size(); ++c)
      for (std::size_t d = 0; d < c; ++d) {
        const bool together = mesh.triangles[c / 3][c % 3] == mesh.triangles[d / 3][d % 3] && fan[c] == fan[d];
        ASSERT_EQ(cut.triangles[c / 3][c % 3] == cut.triangles[d / 3][d % 3], together) << round << ' ' << c << ' ' << d;
      }
  }
}

TEST(FaultCut, ThreadsMakeNoDifference) {
  const FaultNetwork faults(
      {test::dippingFault(-30.0, 3.2, 10.0, 60.0, 0.37), wall("b", {-20, -3.2, 0}, {20, 4.1, 0})});
  const CutMesh one = cutAlongFaults(wavy(), faults, {0.0, 1});
  const CutMesh four = cutAlongFaults(wavy(), faults, {0.0, 4});
  EXPECT_TRUE(test::sameMesh(one.mesh, four.mesh));
  EXPECT_EQ(one.vertex_faults, four.vertex_faults);
}

TEST(Crumbs, SmallComponentsGoUnlessAllAreSmall) {
  CutMesh cut;
  cut.mesh = test::flatGrid(4, 1.0);
  TriangleMesh crumb = test::flatGrid(1, 1.0);
  for (Vector3& v : crumb.vertices)
    v.x() += 50.0;
  append(cut.mesh, crumb);
  cut.vertex_faults.assign(cut.mesh.vertices.size(), {-1, -1});
  cut.vertex_faults[0] = {3, -1};
  EXPECT_EQ(removeCrumbs(cut, 100), 0U);
  EXPECT_EQ(cut.mesh.triangles.size(), 34U);
  EXPECT_EQ(removeCrumbs(cut, 20), 1U);
  EXPECT_EQ(cut.mesh.triangles.size(), 32U);
  EXPECT_EQ(cut.vertex_faults.size(), cut.mesh.vertices.size());
  EXPECT_TRUE(cut.onFault(0, 3));
}

} // namespace
} // namespace graben
