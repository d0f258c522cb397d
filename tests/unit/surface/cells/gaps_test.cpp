#include "shapes.h"

#include "graben/mesh/components.h"
#include "graben/mesh/normals.h"
#include "graben/mesh/triangle_bvh.h"
#include "graben/surface/hoppe_surface.h"

#include <gtest/gtest.h>

namespace graben {
namespace {

/// What the paper's rule alone makes of gaps, no fault given: rho 1 and delta 0.2, so that holes wider than 2 (rho + delta) = 2.4 stay open.
class Gaps : public testing::Test {
protected:
  static constexpr double kWidest = 2.4;

  template <typename Height>
  static test::Oriented picks(const Height& height) {
    return test::sheet(15.0, 0.5, height);
  }

  template <typename Keep>
  static test::Oriented without(const test::Oriented& all, const Keep& keep) {
    test::Oriented o;
    for (std::size_t i = 0; i < all.points.size(); ++i)
      if (keep(all.points[i]))
        o.add(all.points[i], all.normals[i]);
    return o;
  }

  static TriangleMesh surfaceOf(const test::Oriented& o, double voxel_size) {
    HoppeSurfaceOptions options;
    options.voxel_size = voxel_size;
    options.rho = 1.0;
    options.delta = 0.2;
    return hoppeSurface(o.points, o.normals, FaultNetwork(), options).cut.mesh;
  }
};

TEST_F(Gaps, PatchesApartByMoreThanTheRuleBridgesStayApart) {
  for (const double voxel_size : {0.5, 1.0}) {
    for (const auto& [gap, pieces] : {std::pair{kWidest + 1.0, 2U}, {kWidest + 4.0, 2U}, {0.8, 1U}}) {
      const test::Oriented o = without(picks([](double x, double y) { return 0.1 * x + 0.3 * std::sin(0.4 * y); }),
                                       [gap = gap](const Vector3& p) { return std::abs(p.x()) > 0.5 * gap; });
      EXPECT_EQ(checkTopology(surfaceOf(o, voxel_size)).components, pieces) << gap << " at " << voxel_size;
    }
  }
}

TEST_F(Gaps, AHoleOfThatSizeStaysOpenAndASmallOneCloses) {
  for (const double voxel_size : {0.5, 1.0}) {
    for (const auto& [diameter, loops] : {std::pair{kWidest + 1.0, 2U}, {kWidest + 4.0, 2U}, {1.0, 1U}}) {
      const test::Oriented o = without(picks([](double x, double y) { return 0.1 * x + 0.05 * y; }),
                                       [diameter = diameter](const Vector3& p) { return p.head<2>().norm() > 0.5 * diameter; });
      const TriangleMesh mesh = surfaceOf(o, voxel_size);
      EXPECT_EQ(checkTopology(mesh).border_loops, loops) << diameter << " at " << voxel_size;
      if (loops == 2U) {
        const double middle = TriangleBvh(mesh).nearest(Vector3(0.0, 0.0, 0.0)).distance;
        EXPECT_GT(middle, 0.5 * (diameter - kWidest) - 0.1) << "no farther than the rule goes";
      }
    }
  }
}

TEST_F(Gaps, AStepAcrossAGapWithoutPicksIsNotBridged) {
  for (const double step : {1.0, 2.0, 5.0}) {
    const test::Oriented o = without(picks([step](double x, double) { return x < 0.0 ? 0.5 * step : -0.5 * step; }),
                                     [](const Vector3& p) { return std::abs(p.x()) > 0.5 * kWidest + 0.5; });
    const TriangleMesh mesh = surfaceOf(o, 1.0);
    EXPECT_EQ(checkTopology(mesh).components, 2U) << step;
    for (const Triangle& t : mesh.triangles)
      ASSERT_GT(areaNormal(mesh, t).normalized().z(), 0.9) << "no ramp, step " << step;
    const Bounds box = boundsOf(mesh.vertices);
    EXPECT_NEAR(box.size().z(), step, 1e-6);
  }
}

} // namespace
} // namespace graben
