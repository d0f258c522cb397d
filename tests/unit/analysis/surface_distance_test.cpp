#include "graben/analysis/surface_distance.h"

#include "graben/core/errors.h"
#include "unit/analysis/walls.h"
#include "unit/mesh/meshes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace graben {
namespace {

TriangleMesh raised(TriangleMesh mesh, double z) {
  for (Vector3& v : mesh.vertices)
    v.z() += z;
  return mesh;
}

SurfaceDistanceOptions samples(std::size_t count, double zone_width = 0.0, unsigned threads = 0) {
  SurfaceDistanceOptions options;
  options.samples = count;
  options.zone_width = zone_width;
  options.threads = threads;
  return options;
}

TEST(SurfaceDistance, OfAShiftIsTheShift) {
  const SurfaceDistances d =
      surfaceDistances(test::gridMesh(10), raised(test::gridMesh(4, 2.5), 0.25), {}, samples(5000));
  for (const OneWayDistances& way : {d.to_truth, d.from_truth}) {
    EXPECT_EQ(way.all.count, 5000U);
    EXPECT_NEAR(way.all.rms, 0.25, 1e-12);
    EXPECT_NEAR(way.all.p95, 0.25, 1e-12);
    EXPECT_NEAR(way.all.max, 0.25, 1e-12);
    EXPECT_EQ(way.near.count, 0U);
    EXPECT_EQ(way.far.count, 5000U);
  }
}

TEST(SurfaceDistance, WhatIsMissingShowsOneWayOnly) {
  TriangleMesh truth = test::gridMesh(10); // 20 x 10 against 10 x 10
  for (Vector3& v : truth.vertices)
    v.x() *= 2.0;
  const SurfaceDistances d = surfaceDistances(test::gridMesh(10), truth, {}, samples(20000));
  EXPECT_NEAR(d.to_truth.all.max, 0.0, 1e-12);
  EXPECT_NEAR(d.from_truth.all.mean_square, 100.0 / 6.0, 0.05);
  EXPECT_NEAR(d.from_truth.all.mean, 2.5, 0.01);
  EXPECT_NEAR(d.from_truth.all.p95, 9.0, 0.05);
  EXPECT_NEAR(d.from_truth.all.max, 10.0, 1e-12);
}

TEST(SurfaceDistance, SplitsNearFromFar) {
  TriangleMesh mesh = test::gridMesh(20, 0.5);
  for (Vector3& v : mesh.vertices)
    v.z() = v.x() < 1.2 ? 1.0 : 0.0; // a bench beside the fault at x = 0
  const SurfaceDistances d = surfaceDistances(
      mesh, test::gridMesh(10), test::network(test::wall(0, 0, 10)), samples(20000, 2.0));
  EXPECT_NEAR(d.to_truth.far.max, 0.0, 1e-12);
  EXPECT_NEAR(d.to_truth.near.max, 1.0, 1e-12);
  EXPECT_NEAR(d.to_truth.near.p95, 1.0, 1e-12);
  EXPECT_EQ(d.to_truth.near.count + d.to_truth.far.count, d.to_truth.all.count);
}

TEST(SurfaceDistance, WhatLiesBeyondTheTruthsOuterEdgeIsNotCountedIfAskedTo) {
  TriangleMesh truth = test::gridMesh(10); // 0 to 10, the fault at x = 0
  TriangleMesh mesh = raised(test::gridMesh(10), 0.5);
  for (Vector3& v : mesh.vertices)
    v.x() = 1.5 * v.x() - 2.0; // -2 to 13: a curtain before the fault, 3 too far on the other side
  SurfaceDistanceOptions options = samples(20000, 0.01);
  const FaultNetwork network = test::network(test::wall(0, 0, 10));
  EXPECT_NEAR(surfaceDistances(mesh, truth, network, options).to_truth.all.max, std::hypot(3.0, 0.5), 1e-9);
  options.truth_tolerance = 0.1;
  const SurfaceDistances d = surfaceDistances(mesh, truth, network, options);
  EXPECT_NEAR(d.to_truth.all.max, std::hypot(2.0, 0.5), 1e-9);
  // The strip beyond the edge, and of the curtain what is as near to an end of the fault as to the fault.
  EXPECT_NEAR(d.beyond, (30.0 + 4.5) / 150.0, 0.005);
  EXPECT_NEAR(static_cast<double>(d.to_truth.all.count), 20000.0 * (1.0 - d.beyond), 1.0);
  EXPECT_EQ(d.from_truth.all.count, 20000U);
}

TEST(SurfaceDistance, TheTruthNeedNotBeThereInTheMarginOfItsOuterEdge) {
  const TriangleMesh truth = test::gridMesh(10); // 0 to 10, the fault at x = 0
  TriangleMesh mesh = test::gridMesh(10);
  for (Vector3& v : mesh.vertices)
    v = Vector3(0.5 + 0.8 * v.x(), 1.0 + 0.8 * v.y(), 0.0); // ends 0.5 before the fault, 1 to 1.5 before the other edges
  Points picks = truth.vertices;
  SurfaceDistanceOptions options = samples(20000, 0.01);
  options.picks = &picks;
  options.pick_reach = 2.0;
  const FaultNetwork network = test::network(test::wall(0, 0, 10));
  EXPECT_GT(surfaceDistances(mesh, truth, network, options).from_truth_at_picks->all.max, 1.4);
  options.truth_tolerance = 0.1;
  options.margin = 1.6;
  const OneWayDistances d = *surfaceDistances(mesh, truth, network, options).from_truth_at_picks;
  EXPECT_NEAR(d.all.max, 0.5, 1e-9); // at the fault it still counts
  EXPECT_NEAR(static_cast<double>(d.all.count), 20000.0 * (10.0 - 3.2) * (10.0 - 1.6) / 100.0, 100.0);
}

TEST(SurfaceDistance, ASpikeIsInTheMaximumHoweverFewTheSamples) {
  TriangleMesh mesh = test::gridMesh(10);
  mesh.vertices[60].z() = 7.0;
  mesh.vertices.emplace_back(0, 0, 100); // used by no triangle
  EXPECT_NEAR(surfaceDistances(mesh, test::gridMesh(10), {}, samples(1)).to_truth.all.max, 7.0,
              1e-12);
}

TEST(SurfaceDistance, SamplesFollowTheAreaNotTheTriangles) {
  TriangleMesh mesh = test::gridMesh(100, 0.01); // 20000 triangles on a unit square
  append(mesh, test::gridMesh(1, 3.0, 10.0));    // 2 triangles, 9 times the area
  const Points points = sampleSurface(mesh, 10000);
  std::size_t on_large = 0;
  Vector3 centre = Vector3::Zero();
  for (const Vector3& p : points)
    if (p.x() > 5.0) {
      ++on_large;
      centre += p;
    }
  EXPECT_NEAR(static_cast<double>(on_large), 9000.0, 1.0);
  EXPECT_LT((centre / static_cast<double>(on_large) - Vector3(11.5, 11.5, 0)).norm(), 0.01);
  EXPECT_EQ(points, sampleSurface(mesh, 10000));
}

TEST(SurfaceDistance, IsTheSameForEveryThreadCountAndRefusesNonsense) {
  const TriangleMesh mesh = test::gridMesh(10);
  const TriangleMesh truth = raised(test::gridMesh(7, 1.3), 0.1);
  EXPECT_EQ(surfaceDistances(mesh, truth, {}, samples(3000, 0.0, 1)).from_truth.all.mean_square,
            surfaceDistances(mesh, truth, {}, samples(3000, 0.0, 4)).from_truth.all.mean_square);
  EXPECT_THROW(surfaceDistances(TriangleMesh(), truth), InvalidInputError);
  EXPECT_THROW(surfaceDistances(mesh, TriangleMesh()), InvalidInputError);
  EXPECT_THROW(surfaceDistances(mesh, truth, {}, samples(0)), InvalidInputError);
  EXPECT_THROW(surfaceDistances(mesh, truth, {}, samples(5, -1.0)), InvalidInputError);
}

} // namespace
} // namespace graben
