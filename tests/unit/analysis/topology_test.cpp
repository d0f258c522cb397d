#include "graben/analysis/topology.h"

#include "graben/core/errors.h"
#include "unit/mesh/meshes.h"

#include <gtest/gtest.h>

namespace graben {
namespace {

TriangleMesh meshOf(std::vector<Triangle> triangles, int vertices) {
  TriangleMesh mesh;
  for (int v = 0; v < vertices; ++v)
    mesh.vertices.emplace_back(v, v * v, v * v * v); // no three on a line
  mesh.triangles = std::move(triangles);
  return mesh;
}

TEST(Topology, OfAnEmptyMeshIsOk) {
  const TopologyReport report = checkTopology(TriangleMesh());
  EXPECT_TRUE(report.ok());
  EXPECT_EQ(report.components, 0U);
}

TEST(Topology, OfAGridWithAHole) {
  TriangleMesh mesh = test::gridMesh(5);
  mesh.triangles.erase(mesh.triangles.begin() + 24, mesh.triangles.begin() + 26); // the middle cell
  const TopologyReport report = checkTopology(mesh);
  EXPECT_TRUE(report.ok());
  EXPECT_EQ(report.vertices, 36U);
  EXPECT_EQ(report.triangles, 48U);
  EXPECT_EQ(report.components, 1U);
  EXPECT_EQ(report.crumbs, 0U);
  EXPECT_EQ(report.border_edges, 24U);
  EXPECT_EQ(report.border_loops, 2U);
}

TEST(Topology, OfAClosedMeshHasNoBorder) {
  const TopologyReport report =
      checkTopology(meshOf({{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}, 4));
  EXPECT_TRUE(report.ok());
  EXPECT_EQ(report.border_edges, 0U);
  EXPECT_EQ(report.border_loops, 0U);
  EXPECT_EQ(report.crumbs, 1U);
}

TEST(Topology, CountsComponentsAndCrumbs) {
  TriangleMesh mesh = test::gridMesh(4);
  append(mesh, test::gridMesh(3, 1.0, 100.0));
  append(mesh, test::gridMesh(1, 1.0, 200.0));
  const TopologyReport report = checkTopology(mesh);
  EXPECT_EQ(report.components, 3U);
  EXPECT_EQ(report.crumbs, 2U); // 18 and 2 triangles
  EXPECT_TRUE(report.ok());
}

TEST(Topology, AnEdgeOfThreeTrianglesIsNotManifoldItsVerticesAre) {
  const TopologyReport report = checkTopology(meshOf({{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}, 5));
  EXPECT_EQ(report.non_manifold_edges, 1U);
  EXPECT_EQ(report.inconsistent_edges, 0U);
  EXPECT_EQ(report.non_manifold_vertices, 0U);
  EXPECT_FALSE(report.ok());
}

TEST(Topology, TrianglesTurnedAgainstTheirNeighbourAreInconsistent) {
  const TopologyReport report = checkTopology(meshOf({{0, 1, 2}, {0, 1, 3}}, 4));
  EXPECT_EQ(report.inconsistent_edges, 1U);
  EXPECT_EQ(report.non_manifold_edges, 0U);
  EXPECT_EQ(report.non_manifold_vertices, 0U);
  EXPECT_FALSE(report.ok());
}

TEST(Topology, ABowTieIsANonManifoldVertex) {
  const TopologyReport report = checkTopology(meshOf({{0, 1, 2}, {0, 3, 4}, {0, 5, 6}}, 7));
  EXPECT_EQ(report.non_manifold_vertices, 1U);
  EXPECT_EQ(report.non_manifold_edges, 0U);
  EXPECT_EQ(report.components, 1U);
  EXPECT_EQ(report.border_loops, 3U);
  EXPECT_FALSE(report.ok());
}

TEST(Topology, DuplicatesAreFoundInAnyOrderOfCorners) {
  TriangleMesh mesh = meshOf({{0, 1, 2}, {2, 0, 1}, {1, 0, 2}, {2, 1, 3}}, 4);
  EXPECT_EQ(checkTopology(mesh).duplicate_triangles, 2U);
  mesh.triangles.resize(1);
  EXPECT_EQ(checkTopology(mesh).duplicate_triangles, 0U);
}

TEST(Topology, DuplicatesAreFoundWoundEitherWayAndManyTimes) {
  TriangleMesh mesh = test::gridMesh(4);
  const Triangle inside = mesh.triangles[12];
  mesh.triangles.push_back({inside[1], inside[0], inside[2]});
  EXPECT_EQ(checkTopology(mesh).duplicate_triangles, 1U);
  mesh.triangles.push_back(inside);
  EXPECT_EQ(checkTopology(mesh).duplicate_triangles, 2U);
  TriangleMesh pillow;
  pillow.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  pillow.triangles = {{0, 1, 2}, {1, 0, 2}};
  EXPECT_EQ(checkTopology(pillow).duplicate_triangles, 1U);
}

TEST(Topology, DegenerateTrianglesAreFoundAtAnySize) {
  for (const double scale : {1e-6, 1.0, 1e6}) {
    TriangleMesh mesh = test::gridMesh(1, scale);
    const auto v = static_cast<Index>(mesh.vertices.size());
    mesh.vertices.emplace_back(0.5 * scale, 0.0, 0.0);           // on the edge from 0 to 1
    mesh.vertices.emplace_back(0.5 * scale, -1e-6 * scale, 0.0); // thin, but no more
    mesh.vertices.emplace_back(1e-14 * scale, 0.0, 0.0);         // vertex 0 again, nearly
    mesh.vertices.emplace_back(0.0, 1e-14 * scale, 0.0);
    mesh.triangles.push_back({0, v, 1});
    EXPECT_EQ(checkTopology(mesh).degenerate_triangles, 1U);
    mesh.triangles.push_back({0, 0, 1});
    EXPECT_EQ(checkTopology(mesh).degenerate_triangles, 2U);
    mesh.triangles.push_back({0, v + 1, 1});
    EXPECT_EQ(checkTopology(mesh).degenerate_triangles, 2U);
    mesh.triangles.push_back({0, v + 2, v + 3});
    EXPECT_EQ(checkTopology(mesh).degenerate_triangles, 3U);
  }
}

TEST(Topology, CountsVerticesNobodyUsesAndRefusesBrokenMeshes) {
  EXPECT_EQ(checkTopology(meshOf({{0, 1, 2}}, 5)).unreferenced_vertices, 2U);
  EXPECT_FALSE(checkTopology(meshOf({{0, 1, 2}}, 5)).ok());
  EXPECT_THROW(checkTopology(meshOf({{0, 1, 9}}, 5)), InvalidInputError);
}

} // namespace
} // namespace graben
