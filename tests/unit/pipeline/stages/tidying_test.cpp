#include "stages/tidying.h"

#include "measures/against_picks.h"

#include "graben/analysis/flipped_triangles.h"
#include "graben/mesh/normals.h"
#include "graben/surface/crumbs.h"
#include "graben/surface/folds.h"
#include "unit/mesh/meshes.h"

#include <gtest/gtest.h>

#include <numeric>

namespace graben {
namespace {

/// A flat grid with picks at its vertices and a fault across it, then crumpled.
struct Crumpled {
  CutMesh cut;
  Points picks;
  Points normals;
  FaultNetwork faults;
  NeighborGrid grid;

  Crumpled(double by, std::uint64_t seed) {
    cut.mesh = test::gridMesh(24);
    cut.vertex_faults.assign(cut.mesh.vertices.size(), {-1, -1});
    picks = cut.mesh.vertices;
    normals.assign(picks.size(), Vector3::UnitZ());
    grid = NeighborGrid(picks);
    TriangleMesh wall;
    wall.vertices = {{100, 0, -1}, {100, 1, -1}, {100, 1, 1}}; // out of the way
    wall.triangles = {{0, 1, 2}};
    faults = FaultNetwork(std::vector<FaultSurface>{FaultSurface::fromMesh("wall", wall)});
    std::mt19937_64 random(seed);
    for (std::size_t v = 0; v < cut.mesh.vertices.size(); ++v)
      if (test::uniform(random, 0.0, 1.0) < 0.15) {
        cut.mesh.vertices[v] += test::randomPoint(random, -by, by);
        if (test::uniform(random, 0.0, 1.0) < 0.3)
          cut.vertex_faults[v] = {0, -1}; // stays
      }
  }

  TidyingInput input() const { return {grid, normals, faults, 3.0, 0.01, 2}; }
};

/// What tidy() does, by looking at all triangles every time.
TidyingResult tidyByLookingAtAll(Crumpled& c) {
  const VertexCorners corners(c.cut.mesh);
  std::vector<Index> all(c.cut.mesh.triangles.size());
  std::iota(all.begin(), all.end(), 0);
  const auto against = [&] { return trianglesAgainstPicks(c.cut.mesh, all, c.grid, c.normals, 3.0); };
  TidyingResult result;
  computeVertexNormals(c.cut.mesh);
  for (int round = 0; round < 4; ++round) {
    std::size_t found = 0;
    const auto relax = [&](const std::vector<Index>& triangles) {
      if (round >= 2)
        relaxAlongFaults(c.cut, corners, triangles, c.faults);
      relaxTriangles(c.cut, corners, triangles);
      found += triangles.size();
    };
    relax(turnedTriangles(c.cut.mesh, corners, all));
    relax(foldedTriangles(c.cut.mesh));
    relax(against());
    if (found == 0)
      return result;
    computeVertexNormals(c.cut.mesh);
  }
  TriangleRemoval removal(c.cut, corners);
  result.folds = removal.take(turnedTriangles(c.cut.mesh, corners, all));
  result.folds += removal.take(foldedTriangles(c.cut.mesh));
  result.folds += removal.take(against());
  if (!removal.empty())
    result.crumbs = removal.finish(2).crumbs;
  computeVertexNormals(c.cut.mesh);
  return result;
}

TEST(Tidy, FindsAroundWhatItMovedAllThatALookAtTheWholeMeshFinds) {
  std::size_t removed = 0;
  for (const double by : {0.0, 1.2, 3.0})
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
      Crumpled expected(by, seed);
      const TidyingResult plain = tidyByLookingAtAll(expected);
      for (const unsigned threads : {1U, 3U}) {
        Crumpled c(by, seed);
        VertexCorners corners(c.cut.mesh);
        const TidyingResult result = tidy(c.cut, corners, c.input(), threads);
        EXPECT_EQ(result.folds, plain.folds);
        EXPECT_EQ(result.crumbs, plain.crumbs);
        EXPECT_EQ(c.cut.mesh.triangles, expected.cut.mesh.triangles);
        EXPECT_EQ(c.cut.mesh.vertices, expected.cut.mesh.vertices);
        EXPECT_EQ(c.cut.mesh.normals, expected.cut.mesh.normals);
        EXPECT_EQ(c.cut.vertex_faults, expected.cut.vertex_faults);
        const VertexCorners anew(c.cut.mesh);
        EXPECT_EQ(corners.of(0).end() - corners.of(0).begin(), anew.of(0).end() - anew.of(0).begin());
        removed += result.folds;
      }
    }
  EXPECT_GT(removed, 0U);
}

} // namespace
} // namespace graben
