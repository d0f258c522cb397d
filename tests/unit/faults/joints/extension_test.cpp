#include "graben/faults/extension.h"

#include "graben/core/errors.h"
#include "graben/mesh/adjacency.h"
#include "graben/mesh/bounds.h"
#include "graben/mesh/components.h"
#include "graben/mesh/triangle_bvh.h"
#include "real_faults.h"
#include "shapes.h"
#include "support/data.h"

#include <gtest/gtest.h>

#include <limits>

using namespace graben;
using test::Random;

namespace {

void expectExtensionIsSound(const FaultSurface& fault, const FaultSurface& extended) {
  validate(extended.mesh, "test");
  ASSERT_GT(extended.mesh.triangles.size(), fault.mesh.triangles.size());
  for (std::size_t v = 0; v < fault.mesh.vertices.size(); ++v)
    ASSERT_EQ(extended.mesh.vertices[v], fault.mesh.vertices[v]);
  for (std::size_t t = 0; t < fault.mesh.triangles.size(); ++t)
    ASSERT_EQ(extended.mesh.triangles[t], fault.mesh.triangles[t]);
  const EdgeAdjacency before(fault.mesh);
  const EdgeAdjacency after(extended.mesh);
  std::size_t bad_before = 0;
  std::size_t bad_after = 0;
  for (std::size_t h = 0; h < 3 * fault.mesh.triangles.size(); ++h)
    bad_before += before.twin(static_cast<Index>(h)) == EdgeAdjacency::kNonManifold;
  for (std::size_t h = 0; h < 3 * extended.mesh.triangles.size(); ++h)
    bad_after += after.twin(static_cast<Index>(h)) == EdgeAdjacency::kNonManifold;
  EXPECT_EQ(bad_after, bad_before); // same winding everywhere, nothing doubled
  for (std::size_t t = fault.mesh.triangles.size(); t < extended.mesh.triangles.size(); ++t)
    EXPECT_GT(test::normalOf(extended.mesh, t).norm(), 0.0);
}

} // namespace

TEST(Extension, OfAPlaneIsTheTallerPlane) {
  const Vector3 strike(800, 300, 0);
  const Vector3 dip = Vector3(90, -240, -320); // square to the strike
  ASSERT_EQ(strike.dot(dip), 0.0);
  for (const int rows : {1, 3}) {
    const FaultSurface fault = test::plane("plane", {10, 20, 30}, strike, dip, 7, rows);
    const FaultSurface extended = extendedAlongDip(fault, 100.0);
    expectExtensionIsSound(fault, extended);
    EXPECT_NEAR(test::areaOf(extended.mesh), strike.norm() * (dip.norm() + 200.0), 1e-6);
    EXPECT_EQ(borderLoops(extended.mesh, EdgeAdjacency(extended.mesh)).size(), 1U);
    // Corners go on along dip: the lateral tips stay where they are.
    const TriangleBvh bvh(extended.mesh);
    const Vector3 up = -dip.normalized();
    for (const double s : {0.0, 1.0})
      for (const double d : {-99.9, 99.9}) {
        const Vector3 corner = Vector3(10, 20, 30) + s * strike + (d < 0.0 ? 1.0 : 0.0) * dip;
        EXPECT_LT(bvh.nearest(corner + d * up).distance, 1e-9);
      }
  }
}

TEST(Extension, KeepsTipsAndFollowsCurvedFaults) {
  const auto place = [](double s,
                        double d) { // along an arc, dipping outward 60 degrees, d down dip
    const double radius = 1500.0 + 0.5 * d;
    return Vector3(radius * std::cos(2.0 * s), radius * std::sin(2.0 * s), -std::sqrt(0.75) * d);
  };
  const FaultSurface fault = FaultSurface::fromMesh(
      "arc", test::sheet(60, 4, [&](double u, double v) { return place(u, 300.0 * v); }));
  const FaultSurface extended = extendedAlongDip(fault, 150.0);
  expectExtensionIsSound(fault, extended);
  const TriangleBvh bvh(extended.mesh);
  for (double s = 0.02; s < 0.99; s += 0.013)
    for (const double d : {-140.0, -70.0, 370.0, 440.0})
      EXPECT_LT(bvh.nearest(place(s, d)).distance, 3.0);
  for (const double s : {-0.03, 1.03})
    for (double d = -140.0; d < 440.0; d += 20.0)
      EXPECT_GT(bvh.nearest(place(s, d)).distance, 40.0) << s << " " << d;
}

TEST(Extension, UprightAndOverturnedFaultsGoUpAndDownToo) {
  for (const double lean : {0.0, 30.0, -30.0}) {
    const FaultSurface fault = test::plane("upright", {0, 0, 0}, {1000, 0, 0}, {0, lean, -400});
    const FaultSurface extended = extendedAlongDip(fault, 50.0);
    expectExtensionIsSound(fault, extended);
    EXPECT_NEAR(boundsOf(extended.mesh.vertices).size().x(), 1000.0, 1e-9);
    EXPECT_NEAR(boundsOf(extended.mesh.vertices).size().z(),
                400.0 + 100.0 * 400.0 / std::hypot(400.0, lean), 1e-9);
  }
}

TEST(Extension, LeavesHolesAndLateralTipsAlone) {
  TriangleMesh mesh =
      test::sheet(10, 6, [](double u, double v) { return Vector3(1000 * u, 300 * v, -400 * v); });
  mesh.triangles.erase(mesh.triangles.begin() + 64,
                       mesh.triangles.begin() + 70); // a hole in the middle
  const FaultSurface fault = FaultSurface::fromMesh("holed", mesh);
  const FaultSurface extended = extendedAlongDip(fault, 80.0);
  expectExtensionIsSound(fault, extended);
  EXPECT_EQ(borderLoops(extended.mesh, EdgeAdjacency(extended.mesh)).size(), 2U);
  EXPECT_NEAR(test::areaOf(extended.mesh), test::areaOf(fault.mesh) + 2.0 * 80.0 * 1000.0, 1e-6);
}

TEST(Extension, OfRaggedStickFaultsHasNoFolds) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Random random(seed);
    std::vector<FaultStick> sticks;
    for (int i = 0; i < 30; ++i) {
      const Vector3 top(100.0 * i + random.in(-20, 20), 200.0 * std::sin(0.2 * i),
                        random.in(-50, 50));
      const Vector3 down = Vector3(random.in(-0.1, 0.1), -0.5, -0.8).normalized();
      sticks.push_back({{top, top + random.in(150, 350) * down}});
    }
    const FaultSurface fault = FaultSurface::loft("ragged", sticks);
    const FaultSurface extended = extendedAlongDip(fault, 120.0);
    expectExtensionIsSound(fault, extended);
    EXPECT_EQ(connectedComponents(extended.mesh).triangle_count.size(), 1U);
    EXPECT_EQ(borderLoops(extended.mesh, EdgeAdjacency(extended.mesh)).size(), 1U);
    for (std::size_t t = 0; t < extended.mesh.triangles.size(); ++t)
      EXPECT_GT(test::normalOf(extended.mesh, t).z(), 0.0);
    EXPECT_EQ(extendedAlongDip(fault, 120.0).mesh.vertices, extended.mesh.vertices);
  }
}

TEST(Extension, OfRealFaultsIsSound) {
  GRABEN_REQUIRE_DATA(first_file, "modelA4/F1fault.ts");
  for (const char* name :
       {"modelA4/F1fault.ts", "modelA4/F2fault.ts", "cfm/OCBA-PVFZ-MULT-Palos_Verdes_fault-CFM6.ts",
        "cfm/SFBY-NCRH-MULT-Hayward_Rogers_Creek-CFM7.ts",
        "cfm/WTRA-NCVS-PPTV-Pitas_Point_fault_east-CFM6_500m.ts"}) {
    const FaultSurface fault = FaultSurface::fromMesh(
        name, test::readTsurf((test::dataDir() / name).string(), Vector3::Zero()));
    const FaultSurface extended = extendedAlongDip(fault, 200.0);
    expectExtensionIsSound(fault, extended);
    const Vector3 grown =
        boundsOf(extended.mesh.vertices).size() - boundsOf(fault.mesh.vertices).size();
    EXPECT_GT(grown.norm(), 300.0) << name;
    EXPECT_LT(grown.norm(), 450.0) << name;
  }
}

TEST(Extension, ObliqueLastSticksStayTips) {
  std::vector<FaultStick> sticks;
  for (int i = 0; i < 12; ++i) // the last stick lies nearly along strike and faces down dip
    sticks.push_back({{{200.0 * i + (i == 11 ? 500.0 : 0.0), 0, 0}, {200.0 * i, 100, -170}}});
  const FaultSurface fault = FaultSurface::loft("oblique", sticks);
  const FaultSurface extended = extendedAlongDip(fault, 50.0);
  expectExtensionIsSound(fault, extended);
  EXPECT_NEAR(test::areaOf(extended.mesh), test::areaOf(fault.mesh) + 50.0 * (2200.0 + 2700.0),
              1e-6);
  ASSERT_EQ(extended.tip_lines.size(), 2U);
  for (const Points& line : extended.tip_lines)
    EXPECT_EQ(line.size(), 4U);
}

TEST(Extension, RefusesWhatItCannotUse) {
  const FaultSurface fault = test::plane("plane", {0, 0, 0}, {1, 0, 0}, {0, 1, -1});
  EXPECT_THROW(extendedAlongDip(fault, -1.0), InvalidInputError);
  EXPECT_THROW(extendedAlongDip(fault, std::numeric_limits<double>::infinity()), InvalidInputError);
  EXPECT_EQ(extendedAlongDip(fault, 0.0).mesh.triangles, fault.mesh.triangles);
}

TEST(Extension, AlongStrikeGoesOnWhereItIsAskedTo) {
  const Vector3 strike(800, 300, 0);
  const Vector3 dip(90, -240, -320); // square to the strike
  FaultSurface fault = test::plane("plane", {10, 20, 30}, strike, dip, 7, 3);
  const Vector3 far = Vector3(10, 20, 30) + strike;
  fault.tip_lines = {{Vector3(10, 20, 30), Vector3(10, 20, 30) + dip}, {far, far + dip}};
  std::size_t asked = 0;
  const FaultSurface extended = extendedAlongStrike(fault, 100.0, [&](const Points& end, const Points& outward) {
    ++asked;
    EXPECT_EQ(end.size(), outward.size());
    EXPECT_NEAR(std::abs(outward.front().dot(strike.normalized())), 1.0, 1e-9);
    return outward.front().dot(strike) > 0.0;
  });
  EXPECT_EQ(asked, 2U);
  expectExtensionIsSound(fault, extended);
  EXPECT_NEAR(test::areaOf(extended.mesh), (strike.norm() + 100.0) * dip.norm(), 1e-6);
  EXPECT_EQ(extended.tip_lines[0], fault.tip_lines[0]);
  EXPECT_LT((extended.tip_lines[1].front() - far - 100.0 * strike.normalized()).norm(), 1e-9);
  const FaultSurface same = extendedAlongStrike(fault, 100.0, [](const Points&, const Points&) { return false; });
  EXPECT_EQ(same.mesh.triangles, fault.mesh.triangles);
}
