#include "graben/analysis/evaluation.h"

#include "graben/analysis/report_json.h"
#include "graben/core/errors.h"
#include "unit/analysis/walls.h"
#include "unit/mesh/meshes.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace graben {
namespace {

TriangleMesh moved(TriangleMesh mesh, const Vector3& by) {
  for (Vector3& v : mesh.vertices)
    v += by;
  return mesh;
}

/// Two sheets of 10 x 10 at a wall in x = 0, \a gap short of it on the right.
TriangleMesh sheets(double gap) {
  TriangleMesh mesh = moved(test::gridMesh(10), {-10, 0, 1});
  append(mesh, moved(test::gridMesh(10), {gap, 0, -1}));
  return mesh;
}

EvaluationInput input(double gap) {
  EvaluationInput result;
  result.mesh = sheets(gap);
  result.truth = sheets(0.0);
  result.faults = test::network(test::wall(0, -1, 11));
  result.picks = {{-9, 5, 1}, {-1, 5, 1.5}, {9, 5, -1}};
  result.cutoffs = {{{0, 0, 1}, {0, 10, 1}}, {{0, 0, -1}, {0, 10, -1}}};
  return result;
}

EvaluationOptions options() {
  EvaluationOptions o;
  o.zone_width = 3.0;
  o.voxel_size = 1.0;
  o.samples = 5000;
  return o;
}

TEST(Evaluation, OfTheTruthItselfFindsNothingWrong) {
  const SurfaceEvaluation e = evaluateSurface(input(0.0), options());
  EXPECT_TRUE(e.ok());
  EXPECT_TRUE(e.flipped.triangles.empty());
  EXPECT_NEAR(e.truth->to_truth.all.max, 0.0, 1e-12);
  EXPECT_NEAR(e.cutoffs->all.max, 0.0, 1e-12);
  EXPECT_EQ(e.truth_components, 2U);
  EXPECT_EQ(e.topology.components, 2U);
  EXPECT_EQ(e.seal_by_truth->all.share, 1.0);
  EXPECT_EQ(e.seal_by_truth->all.vertices, 22U); // not the outer edge, though it runs into the zone
  EXPECT_EQ(e.picks->all.count, 3U);
  EXPECT_EQ(e.picks->zone.count, 1U);
  EXPECT_NEAR(e.picks->zone.rms, 0.5, 1e-12);
  EXPECT_EQ(e.picks->away.count, 2U);
  EXPECT_EQ(e.picks->away.max, 0.0);
}

TEST(Evaluation, SeesASheetThatStopsShortOfTheFault) {
  const SurfaceEvaluation e = evaluateSurface(input(1.5), options());
  EXPECT_TRUE(e.ok());
  // 11 of the left sheet; of the right one the 7 that are nearer to the cutoff line than to the
  // outer edge
  EXPECT_EQ(e.seal_by_truth->all.vertices, 18U);
  EXPECT_EQ(e.seal_by_truth->all.on_fault, 11U);
  EXPECT_NEAR(e.seal_by_truth->all.max, 1.5, 1e-12);
  EXPECT_EQ(e.seal->all.vertices,
            13U); // the narrow zone does not see it, but two of the outer edge
  EXPECT_NEAR(e.cutoffs->lines[1].rms, 1.5, 1e-9);
  EXPECT_NEAR(e.truth->from_truth.near.max, 1.5, 1e-12);
}

TEST(Evaluation, WithoutInputsMeasuresTheMeshAlone) {
  EvaluationInput bare;
  bare.mesh = test::gridMesh(3);
  const SurfaceEvaluation e = evaluateSurface(bare);
  EXPECT_EQ(e.voxel_size, 1.0); // the median edge
  EXPECT_FALSE(e.picks || e.bridging_triangles || e.seal || e.truth || e.cutoffs ||
               e.seal_by_truth);
  const auto json = toJson<nlohmann::ordered_json>(e);
  EXPECT_EQ(json["topology"]["pieces"], 1U);
  EXPECT_FALSE(json.contains("truth"));
  bare.picks = {{1, 1, 1}};
  const SurfaceEvaluation with_picks = evaluateSurface(bare);
  EXPECT_EQ(with_picks.picks->away.count, 1U);
  EXPECT_EQ(with_picks.picks->zone.count, 0U);
}

TEST(Evaluation, IsNotOkWithABridgeOrBadTopology) {
  EvaluationInput uncut;
  uncut.mesh = moved(test::gridMesh(10), {-4.5, 0, 0});
  uncut.faults = test::network(test::wall(0, -1, 11));
  EXPECT_EQ(evaluateSurface(uncut).bridging_triangles->size(), 20U);
  EXPECT_FALSE(evaluateSurface(uncut).ok());
  EvaluationInput twice;
  twice.mesh = test::gridMesh(2);
  twice.mesh.triangles.push_back(twice.mesh.triangles[0]);
  EXPECT_FALSE(evaluateSurface(twice).ok());
}

TEST(Evaluation, TruthThatNoPickIsNearToIsNotMissing) {
  EvaluationInput half;
  half.truth = test::gridMesh(20);
  half.mesh = test::gridMesh(10);
  for (int i = 0; i <= 10; ++i)
    for (int j = 0; j <= 10; ++j)
      half.picks.emplace_back(i, j, 0);
  EvaluationOptions o;
  o.pick_reach = 1.5;
  const SurfaceEvaluation e = evaluateSurface(half, o);
  EXPECT_NEAR(e.truth->from_truth.all.max, std::sqrt(200.0), 1e-9);
  EXPECT_NEAR(e.truth->from_truth_at_picks->all.max, 1.0, 0.6);
  EXPECT_LT(e.truth->from_truth_at_picks->all.count, e.truth->from_truth.all.count / 2);
  EXPECT_EQ(e.pick_reach, 1.5);
  const auto json = toJson<nlohmann::ordered_json>(e);
  EXPECT_EQ(json["truth"]["truth_to_surface_at_picks"]["all"]["count"], e.truth->from_truth_at_picks->all.count);
  EXPECT_NEAR(evaluateSurface(half).pick_reach, 6.0, 1.5);
  half.picks.clear();
  EXPECT_FALSE(evaluateSurface(half).truth->from_truth_at_picks);
}

TEST(Evaluation, RefusesNonsense) {
  EXPECT_THROW(evaluateSurface({}), InvalidInputError);
  EvaluationInput bare;
  bare.mesh = test::gridMesh(3);
  for (int bad = 0; bad < 4; ++bad) {
    EvaluationOptions o;
    (bad == 0 ? o.zone_width : bad == 1 ? o.voxel_size : o.on_fault) = bad == 0 ? 0.0 : -1.0;
    if (bad == 3) {
      o = EvaluationOptions();
      o.samples = 0;
    }
    EXPECT_THROW(evaluateSurface(bare, o), InvalidInputError) << bad;
  }
}

} // namespace
} // namespace graben
