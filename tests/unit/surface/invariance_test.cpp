#include "shapes.h"

#include "graben/analysis/approximation_error.h"
#include "graben/surface/hoppe_surface.h"
#include "graben/surface/local_fit.h"
#include "graben/surface/zone_fit.h"

#include <gtest/gtest.h>

namespace graben {
namespace {

/// x -> scale (turn x) + shift
struct Motion {
  double scale = 1.0;
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  Vector3 shift = Vector3::Zero();

  Vector3 of(const Vector3& p) const { return scale * (turn * p) + shift; }
  Vector3 back(const Vector3& p) const { return turn.transpose() * (p - shift) / scale; }
};

/// A wavy horizon with throw at a fault that ends inside.
class InvarianceTest : public testing::Test {
protected:
  InvarianceTest() {
    const auto fall = [](double y) {
      return y < 3.0 ? 1.2 * (1.0 - std::exp(0.2 * (y - 3.0))) : 0.0;
    };
    const auto height = [&](double x, double y) {
      return 0.4 * std::sin(0.3 * x + 0.2 * y) + (x < 0.0 ? 1.0 : -1.0) * fall(y);
    };
    picks_ = test::sheet(12.0, 0.6, height);
    test::Random random(8);
    for (Vector3& p : picks_.points)
      p.z() += random.normal(0.02);
  }

  /// All stages on moved data, the mesh brought back.
  TriangleMesh run(const Motion& m) const {
    Points points, normals;
    for (std::size_t i = 0; i < picks_.points.size(); ++i) {
      points.push_back(m.of(picks_.points[i]));
      normals.push_back(m.turn * picks_.normals[i]);
    }
    TriangleMesh fault = test::dippingFault(-30.0, 3.0, 12.0, 80.0).mesh;
    for (Vector3& v : fault.vertices)
      v = m.of(v);
    const FaultNetwork faults({FaultSurface::fromMesh("fault", fault)});
    HoppeSurfaceOptions options;
    options.voxel_size = 0.75 * m.scale;
    HoppeSurface surface = hoppeSurface(points, normals, faults, options);
    const NeighborGrid grid(points);
    TangentPlanes planes;
    planes.centres = points;
    planes.normals = normals;
    ZoneFitOptions fit;
    fit.zone_width = 3.0 * m.scale;
    fit.max_step = 0.75 * m.scale;
    fitZone(surface.cut, grid, planes, faults, fit);
    const LocalFit local(grid, planes, faults, 6.0 * m.scale);
    RefineOptions refinement;
    refinement.models = {{2, 25}, {1, 18}, 0.0, 0.0};
    refinement.zone_width = 3.0 * m.scale;
    refine(surface.cut, local, refinement);
    for (Vector3& v : surface.cut.mesh.vertices)
      v = m.back(v);
    return std::move(surface.cut.mesh);
  }

  static void expectSameVertices(const TriangleMesh& a, const TriangleMesh& b, double tolerance) {
    ASSERT_EQ(a.vertices.size(), b.vertices.size());
    EXPECT_EQ(a.triangles, b.triangles);
    double worst = 0.0;
    for (std::size_t v = 0; v < a.vertices.size(); ++v)
      worst = std::max(worst, (a.vertices[v] - b.vertices[v]).norm());
    EXPECT_LT(worst, tolerance);
  }

  test::Oriented picks_;
};

TEST_F(InvarianceTest, Scale) {
  const TriangleMesh expected = run({});
  for (const double scale : {1e-3, 1e3}) {
    Motion m;
    m.scale = scale;
    expectSameVertices(run(m), expected, 1e-7);
  }
}

TEST_F(InvarianceTest, ShiftByWholeVoxels) {
  Motion m;
  m.shift = {0.75 * 4000, -0.75 * 12000, 0.75 * 300};
  expectSameVertices(run(m), run({}), 1e-7);
}

TEST_F(InvarianceTest, AnyRigidMotionGivesTheSameSurface) {
  const TriangleMesh expected = run({});
  Motion m;
  m.turn = Eigen::AngleAxisd(0.6, Vector3(0.3, 0.2, 1.0).normalized()).toRotationMatrix();
  m.shift = {13.1, -7.7, 3.3};
  const TriangleMesh turned = run(m);
  EXPECT_EQ(checkTopology(turned).components, checkTopology(expected).components);
  EXPECT_EQ(checkTopology(turned).border_loops, checkTopology(expected).border_loops);
  EXPECT_TRUE(checkTopology(turned).ok());
  EXPECT_NEAR(test::areaOf(turned), test::areaOf(expected), 0.06 * test::areaOf(expected));
  Points inner;
  for (const Vector3& v : turned.vertices)
    if (v.head<2>().cwiseAbs().maxCoeff() < 11.0)
      inner.push_back(v);
  EXPECT_LT(approximationError(expected, inner).rms, 0.02);
  EXPECT_LT(approximationError(expected, inner).p95, 0.03);
}

} // namespace
} // namespace graben
