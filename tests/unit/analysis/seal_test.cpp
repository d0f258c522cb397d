#include "graben/analysis/seal.h"

#include "graben/core/errors.h"
#include "unit/analysis/walls.h"
#include "unit/mesh/meshes.h"

#include <gtest/gtest.h>

namespace graben {
namespace {

SealOptions options(double zone_width, double tolerance) {
  SealOptions result;
  result.zone_width = zone_width;
  result.tolerance = tolerance;
  return result;
}

TEST(Seal, CountsBorderVerticesInTheZoneOnly) {
  TriangleMesh mesh = test::gridMesh(10); // its edge x = 10 is the cut
  mesh.vertices[3 * 11 + 10].x() -= 0.1;
  mesh.vertices[7 * 11 + 10].x() += 0.3;
  const SealReport report =
      checkSeal(mesh, test::network(test::wall(10, -1, 11)), options(0.9, 1e-9));
  ASSERT_EQ(report.faults.size(), 1U);
  EXPECT_EQ(report.all.vertices, 11U);
  EXPECT_EQ(report.all.on_fault, 9U);
  EXPECT_DOUBLE_EQ(report.all.share, 9.0 / 11.0);
  EXPECT_EQ(report.all.p50, 0.0);
  EXPECT_NEAR(report.all.max, 0.3, 1e-12);
  EXPECT_NEAR(report.all.p95, 0.3, 1e-12);
  EXPECT_EQ(checkSeal(mesh, test::network(test::wall(10, -1, 11)), options(0.9, 0.2)).all.on_fault,
            10U);
}

TEST(Seal, IsToldFaultByFault) {
  const SealReport report = checkSeal(
      test::gridMesh(10),
      test::network(test::wall(0, -1, 11), test::wall(10.25, -1, 11), test::wall(50, 0, 1)),
      options(0.5, 1e-9));
  ASSERT_EQ(report.faults.size(), 3U);
  EXPECT_EQ(report.faults[0].vertices, 11U);
  EXPECT_EQ(report.faults[0].share, 1.0);
  EXPECT_EQ(report.faults[1].vertices, 11U);
  EXPECT_EQ(report.faults[1].on_fault, 0U);
  EXPECT_NEAR(report.faults[1].p50, 0.25, 1e-12);
  EXPECT_EQ(report.faults[2].vertices, 0U);
  const SealReport at_limit =
      checkSeal(test::gridMesh(10), test::network(test::wall(10.25, -1, 11)), options(0.5, 0.25));
  EXPECT_EQ(at_limit.all.share, 1.0); // the tolerance itself is on the fault
  EXPECT_EQ(report.all.vertices, 22U);
  EXPECT_DOUBLE_EQ(report.all.share, 0.5);
}

TEST(Seal, IsTheSameWhereTheAdjacencyIsAtHand) {
  const TriangleMesh mesh = test::gridMesh(10);
  const FaultNetwork faults = test::network(test::wall(0.2, 3, 7), test::wall(10, -1, 11));
  const SealReport found = checkSeal(mesh, faults, options(0.9, 1e-9));
  const SealReport same = checkSeal(mesh, EdgeAdjacency(mesh), faults, options(0.9, 1e-9));
  ASSERT_GT(found.faults[0].vertices, 0U);
  for (std::size_t f = 0; f < 2; ++f) {
    EXPECT_EQ(same.faults[f].vertices, found.faults[f].vertices);
    EXPECT_EQ(same.faults[f].on_fault, found.faults[f].on_fault);
    EXPECT_EQ(same.faults[f].p95, found.faults[f].p95);
  }
  EXPECT_THROW(checkSeal(mesh, EdgeAdjacency(mesh), faults, options(0, 0)), InvalidInputError);
}

TEST(Seal, InnerVerticesOnTheFaultAreNoBorder) {
  EXPECT_EQ(checkSeal(test::gridMesh(10), test::network(test::wall(5, -1, 11)), options(0.5, 1e-9))
                .all.vertices,
            2U);
}

TEST(Seal, BeyondTheEndsOfTheTruthsBorderAtAFaultNothingIsCounted) {
  const TriangleMesh truth = test::gridMesh(10); // its edge x = 10 is the cut
  TriangleMesh mesh = test::gridMesh(16);
  for (Vector3& v : mesh.vertices)
    v -= Vector3(6, 3, 0);
  SealOptions by_truth = options(2.5, 1e-9);
  by_truth.truth = &truth;
  by_truth.truth_tolerance = 0.1;
  const FaultNetwork faults = test::network(test::wall(10, -4, 14));
  EXPECT_EQ(checkSeal(mesh, faults, by_truth).all.vertices, 11U); // y = 0 to 10
  EXPECT_EQ(checkSeal(mesh, faults, by_truth).all.share, 1.0);
}

TEST(Seal, WithoutFaultsIsEmptyAndRefusesNonsense) {
  const TriangleMesh mesh = test::gridMesh(2);
  EXPECT_EQ(checkSeal(mesh, FaultNetwork(), options(1, 0)).all.vertices, 0U);
  EXPECT_THROW(checkSeal(mesh, FaultNetwork(), SealOptions()), InvalidInputError);
  EXPECT_THROW(checkSeal(mesh, FaultNetwork(), options(1, -1)), InvalidInputError);
}

} // namespace
} // namespace graben
