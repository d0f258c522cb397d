#include "cases.h"

#include "graben/faults/fault_surface.h"
#include "graben/mesh/adjacency.h"
#include "graben/mesh/normals.h"
#include "graben/mesh/triangle_bvh.h"

#include <algorithm>
#include <cmath>

namespace graben {
namespace {

using test::EveryKind;

double farthest(const SyntheticModel& model, std::size_t fault, const TriangleMesh& mesh) {
  const TriangleBvh bvh(mesh);
  double worst = 0.0;
  for (const TrueCutoffLine& line : model.cutoffLines())
    if (line.fault == static_cast<Index>(fault))
      for (const Vector3& p : line.points)
        worst = std::max(worst, bvh.nearest(p).distance);
  return worst;
}

class GivenFaults : public EveryKind {};

TEST_P(GivenFaults, MeshAndSticksHoldTheCutoffs) {
  SyntheticOptions o = options();
  o.frame = test::utmDepth();
  const SyntheticModel model(o);
  // A chord's sagitta: amplitude * wave number^2 * spacing^2 / 8, and a little for the bend.
  const double wave = 2.0 * 3.14159265 / (0.35 * o.size);
  const double mesh_error =
      o.waviness * std::pow(wave * o.fault_mesh_size, 2) / 8.0 + (o.bend > 0.0 ? 1.0 : 1e-6);
  const double stick_error =
      o.waviness * std::pow(wave * o.stick_spacing, 2) / 8.0 + (o.bend > 0.0 ? 4.0 : 1e-6);
  for (std::size_t i = 0; i < model.faultCount(); ++i) {
    EXPECT_LT(farthest(model, i, model.faultMesh(i)), mesh_error);
    EXPECT_LT(farthest(model, i, FaultSurface::loft("F", model.faultSticks(i)).mesh), stick_error);
  }
}

TEST_P(GivenFaults, MeshIsCleanOnTheFaultAndTurnedToTheHangingWall) {
  SyntheticOptions o = options();
  o.frame = test::utmDepth();
  const SyntheticModel model(o);
  for (std::size_t i = 0; i < model.faultCount(); ++i) {
    const TriangleMesh mesh = model.faultMesh(i);
    const EdgeAdjacency adjacency(mesh);
    for (Index edge = 0; edge < static_cast<Index>(3 * mesh.triangles.size()); ++edge)
      ASSERT_NE(adjacency.twin(edge), EdgeAdjacency::kNonManifold);
    EXPECT_EQ(borderLoops(mesh, adjacency).size(), 1u);
    for (const Vector3& p : mesh.vertices)
      EXPECT_LT(std::abs(model.faultOffset(i, p)), 1e-6);
    for (const Triangle& t : mesh.triangles) {
      const Vector3 step = areaNormal(mesh, t).normalized();
      const Vector3& corner = mesh.vertices[static_cast<std::size_t>(t[0])];
      EXPECT_GT(model.faultOffset(i, corner + step), 0.0);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(, GivenFaults, testing::ValuesIn(test::allKinds()), test::nameOf);

std::pair<double, double> levels(const TriangleMesh& mesh, double y) {
  std::pair<double, double> range(1e300, -1e300);
  for (const Vector3& p : mesh.vertices)
    if (std::abs(p.y() - y) < 60.0)
      range = {std::min(range.first, p.z()), std::max(range.second, p.z())};
  return range;
}

TEST(FaultOverhang, MayStopShortOfTheHorizon) {
  SyntheticOptions o;
  o.relief = 0.0;
  o.throw_variation = 0.0;
  EXPECT_NEAR(levels(SyntheticModel(o).faultMesh(0), 0.0).first, -50.0 - 150.0, 1e-6);
  EXPECT_NEAR(levels(SyntheticModel(o).faultMesh(0), 0.0).second, 50.0 + 150.0, 1e-6);
  o.overhang_below = -120.0; // ends 70 m above the horizon of the hanging wall's other side
  EXPECT_NEAR(levels(SyntheticModel(o).faultMesh(0), 0.0).first, -50.0 + 120.0, 1e-6);
}

TEST(FaultShift, MovesTheGivenFaultOnly) {
  SyntheticOptions o;
  o.fault_shift = 35.0;
  const SyntheticModel model(o);
  for (const Vector3& p : model.faultMesh(0).vertices)
    EXPECT_NEAR(model.faultOffset(0, p), 35.0, 1e-6);
}

TEST(FaultTip, GivenFaultEndsAtTheTip) {
  const SyntheticModel model(SyntheticOptions::of(SyntheticKind::Tip));
  const Vector3 tip = model.cutoffLines()[0].points.back();
  const std::vector<FaultStick> sticks = model.faultSticks(0);
  double nearest = 1e300;
  for (const Vector3& p : sticks.back().points)
    nearest = std::min(nearest, (p - tip).norm());
  EXPECT_LT(nearest, 150.0); // the tip lies on the last stick, between its points
  const TriangleMesh mesh = model.faultMesh(0);
  for (const Vector3& p : mesh.vertices)
    EXPECT_LT(p.y(), tip.y() + 100.0);
}

TEST(FaultBranch, EndsAtTheMainFaultOrShortOfIt) {
  for (const double gap : {0.0, 40.0}) {
    SyntheticOptions o = SyntheticOptions::of(SyntheticKind::Branch);
    o.branch_gap = gap;
    const SyntheticModel model(o);
    const TriangleBvh main(model.faultMesh(0));
    const TriangleMesh branch = model.faultMesh(1);
    double nearest = 1e300;
    for (const Vector3& p : branch.vertices) {
      EXPECT_GT(model.faultOffset(0, p), -1e-6);
      nearest = std::min(nearest, main.nearest(p).distance);
    }
    if (gap == 0.0) {
      EXPECT_LT(nearest, 1e-6);
    } else {
      EXPECT_GT(nearest, 20.0);
      EXPECT_LT(nearest, 40.0);
    }
  }
}

TEST(FaultSticks, HaveTheSpacingAndPointsAskedFor) {
  SyntheticOptions o;
  o.stick_spacing = 400.0;
  o.points_per_stick = 2;
  const std::vector<FaultStick> sticks = SyntheticModel(o).faultSticks(0);
  for (std::size_t i = 0; i < sticks.size(); ++i) {
    ASSERT_EQ(sticks[i].points.size(), 2u);
    EXPECT_GT(sticks[i].points[0].z(), sticks[i].points[1].z());
    if (i > 0) {
      EXPECT_LT((sticks[i].points[0] - sticks[i - 1].points[0]).norm(), 420.0);
      EXPECT_GT((sticks[i].points[0] - sticks[i - 1].points[0]).norm(), 300.0);
    }
  }
}

TEST(FaultDip, IsAsAsked) {
  for (const double dip : {30.0, 60.0, 90.0}) {
    SyntheticOptions o;
    o.dip = dip;
    const TriangleMesh mesh = SyntheticModel(o).faultMesh(0);
    for (const Triangle& t : mesh.triangles) {
      const Vector3 n = areaNormal(mesh, t).normalized();
      EXPECT_NEAR(std::acos(std::clamp(n.z(), -1.0, 1.0)) * 180.0 / 3.14159265358979, dip, 1e-3);
    }
  }
}

} // namespace
} // namespace graben
