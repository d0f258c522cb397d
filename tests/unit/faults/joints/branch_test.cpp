#include "graben/faults/fault_network.h"

#include "graben/core/errors.h"
#include "graben/mesh/adjacency.h"
#include "real_faults.h"
#include "shapes.h"
#include "support/data.h"

#include <gtest/gtest.h>

using namespace graben;
using test::Random;

namespace {

constexpr double kReach = 150.0;

/// The main fault along x, dipping to -y; wavy down dip if asked.
FaultSurface mainFault(double wave = 0.0) {
  return FaultSurface::fromMesh(
      "main", test::sheet(40, wave > 0.0 ? 120 : 6, [wave](double u, double v) {
        const double z = 400.0 * (0.5 - v);
        return Vector3(4000.0 * u - 2000.0, 0.75 * z + wave * std::sin(z / 15.0), z);
      }));
}

/// y on the plane main fault at x, z.
double mainY(double, double z) {
  return 0.75 * z;
}

/// A fault that comes obliquely from the -y side and ends \a gap short of the main fault (negative:
/// beyond it).
FaultSurface branchFault(double gap, int columns = 10, int rows = 3) {
  const Vector3 along = Vector3(1.0, 1.5, 0.0).normalized();
  return FaultSurface::fromMesh("branch", test::sheet(columns, rows, [&](double u, double v) {
                                  const double z = 320.0 * (0.5 - v);
                                  const Vector3 end(0.4 * z, mainY(0.4 * z, z), z);
                                  return Vector3(end - (gap + 1500.0 * (1.0 - u)) * along);
                                }));
}

/// Ways from one side of the branch to the other, along the near side of the main fault, that no
/// fault bars.
std::size_t leaks(const FaultNetwork& network) {
  const Vector3 along = Vector3(1.0, 1.5, 0.0).normalized();
  std::size_t count = 0;
  Random random(9);
  for (int i = 0; i < 4000; ++i) {
    const double z = random.in(-120.0, 120.0);
    const Vector3 end(0.4 * z, mainY(0.4 * z, z), z);
    const auto nearMain = [&] {
      const double x = 0.4 * z + random.in(-150.0, 150.0);
      return Vector3(x, mainY(x, z) - random.in(0.02, 60.0), z);
    };
    const Vector3 p = nearMain();
    const Vector3 q = nearMain();
    const bool across = ((p - end).cross(along).z() > 0.0) != ((q - end).cross(along).z() > 0.0);
    count += across && !network.crosses(p, q);
  }
  return count;
}

/// How far the branch goes beyond the plane of the main fault, along y.
double farthestBeyond(const FaultNetwork& network) {
  double farthest = -1e300;
  for (const Vector3& p : network.fault(1).mesh.vertices)
    if (std::abs(p.x()) < 1900.0 && std::abs(p.z()) < 200.0)
      farthest = std::max(farthest, p.y() - mainY(p.x(), p.z()));
  return farthest;
}

void expectSound(const TriangleMesh& mesh) {
  validate(mesh, "test");
  const EdgeAdjacency adjacency(mesh);
  EXPECT_EQ(borderLoops(mesh, adjacency).size(), 1U);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    EXPECT_GT(test::normalOf(mesh, t).norm(), 1e-6);
    for (std::size_t e = 0; e < 3; ++e)
      EXPECT_NE(adjacency.twin(static_cast<Index>(3 * t + e)), EdgeAdjacency::kNonManifold);
  }
}

} // namespace

TEST(Branch, EndingShortIsExtendedToTheMainFault) {
  for (const double gap : {0.0, 1.0, 40.0, 120.0}) {
    const FaultNetwork apart({mainFault(), branchFault(gap)});
    EXPECT_TRUE(apart.branches().empty());
    const FaultNetwork network({mainFault(), branchFault(gap)}, kReach);
    ASSERT_EQ(network.branches().size(), 1U) << gap;
    EXPECT_EQ(network.branches()[0].fault, 1);
    EXPECT_EQ(network.branches()[0].main_fault, 0);
    EXPECT_EQ(network.branches()[0].side, network.side(0, {0, -500, 0}));
    EXPECT_NEAR(network.branches()[0].gap, gap, 0.3 * gap + 0.01);
    EXPECT_EQ(leaks(network), 0U) << gap;
    if (gap > 0.0) {
      EXPECT_GT(leaks(apart), 0U);
    }
    const double beyond = farthestBeyond(network);
    EXPECT_GT(beyond, 0.2 * kReach / 100.0);
    EXPECT_LT(beyond, 2.0 * kReach / 100.0);
    expectSound(network.fault(1).mesh);
    EXPECT_EQ(network.fault(0).mesh.triangles, mainFault().mesh.triangles);
  }
}

TEST(Branch, ExtensionFollowsABentMainFault) {
  for (const int rows : {1, 5}) {
    const FaultNetwork network({mainFault(15.0), branchFault(70.0, 6, rows)}, kReach);
    ASSERT_EQ(network.branches().size(), 1U);
    // Every point of the new border lies just through the main fault.
    const TriangleMesh& mesh = network.fault(1).mesh;
    const EdgeAdjacency adjacency(mesh);
    std::size_t through = 0;
    for (std::size_t h = 0; h < 3 * mesh.triangles.size(); ++h) {
      if (!adjacency.isBorder(static_cast<Index>(h)))
        continue;
      const Vector3& a = mesh.vertices[static_cast<std::size_t>(mesh.triangles[h / 3][h % 3])];
      const Vector3& b =
          mesh.vertices[static_cast<std::size_t>(mesh.triangles[h / 3][(h + 1) % 3])];
      if (network.side(0, a) != network.side(0, {0, 500, 0}) ||
          network.side(0, b) != network.side(0, {0, 500, 0}))
        continue;
      for (double t = 0.0; t <= 1.0; t += 0.05) {
        const FaultPoint at = network.nearest(0, a + t * (b - a));
        EXPECT_EQ(at.side, network.side(0, {0, 500, 0}));
        EXPECT_LT(at.distance, 2.0 * kReach / 100.0);
        ++through;
      }
    }
    EXPECT_GE(through, 20U);
    expectSound(mesh);
  }
}

TEST(Branch, OvershootingIsTrimmedToJustThrough) {
  for (const double overshoot : {5.0, 60.0, 140.0})
    for (const int columns : {1, 10, 60}) {
      const FaultNetwork network({mainFault(), branchFault(-overshoot, columns, 4)}, 1.2 * kReach);
      ASSERT_EQ(network.branches().size(), 1U) << overshoot << " " << columns;
      EXPECT_EQ(network.branches()[0].fault, 1);
      EXPECT_EQ(network.branches()[0].gap, 0.0);
      EXPECT_EQ(leaks(network), 0U);
      EXPECT_LT(farthestBeyond(network), 2.0 * 1.2 * kReach / 100.0);
      EXPECT_GT(farthestBeyond(network), 0.2 * kReach / 100.0);
      expectSound(network.fault(1).mesh);
    }
}

TEST(Branch, CrossingFaultsAreLeftAlone) {
  const FaultSurface crossing = branchFault(-700.0);
  const FaultNetwork network({mainFault(), crossing}, kReach);
  EXPECT_TRUE(network.branches().empty());
  EXPECT_EQ(network.fault(1).mesh.triangles, crossing.mesh.triangles);
}

TEST(Branch, GoingOnFarBehindTheMainFaultInPartIsLeftAlone) {
  // 60 beyond the main fault at the top, 700 at the bottom: that crosses.
  const FaultSurface skew = FaultSurface::fromMesh(
      "skew", test::sheet(30, 8, [](double u, double v) {
        const double z = 320.0 * (0.5 - v);
        return Vector3(0.0, mainY(0.0, z) + 60.0 + 640.0 * v * v - (1.0 - u) * 1500.0, z);
      }));
  const FaultNetwork network({mainFault(), skew}, kReach);
  EXPECT_TRUE(network.branches().empty());
  EXPECT_NEAR(test::areaOf(network.fault(1).mesh), test::areaOf(skew.mesh), 1e-6);
}

TEST(Branch, SmallFaultBesideTheMainFaultKeepsItsFarEnd) {
  const FaultSurface small =
      FaultSurface::fromMesh("small", test::sheet(4, 4, [](double u, double v) {
                               const double z = 100.0 * (0.5 - v);
                               return Vector3(0.0, mainY(0.0, z) - 5.0 - 60.0 * u, z);
                             }));
  const FaultNetwork network({mainFault(), small}, kReach);
  EXPECT_FALSE(network.branches().empty());
  const TriangleBvh bvh(network.fault(1).mesh);
  for (const Vector3& p : small.mesh.vertices)
    EXPECT_LT(bvh.nearest(p).distance, 1e-9);
  EXPECT_GT(test::areaOf(network.fault(1).mesh), test::areaOf(small.mesh));
}

TEST(Branch, MayMeetAMainFaultThatIsShorterDownDip) {
  const FaultSurface upper =
      FaultSurface::fromMesh("upper", test::sheet(20, 4, [](double u, double v) {
                               return Vector3(2000.0 * u - 1000.0, 0.75 * 200.0 * v, 200.0 * v);
                             }));
  for (const int rows : {1, 6}) {
    const FaultNetwork network({upper, branchFault(40.0, 10, rows)}, kReach);
    ASSERT_EQ(network.branches().size(), 1U) << rows;
    for (double z = 25.0; z < 155.0; z += 5.0) {
      const Vector3 end(0.4 * z, mainY(0.4 * z, z), z);
      for (double back = 0.5; back < 40.0; back += 3.0) {
        const Vector3 p = end - back * Vector3(1.0, 1.5, 0.0).normalized();
        EXPECT_TRUE(network.crosses(p - Vector3(9, -6, 0), p + Vector3(9, -6, 0)))
            << z << " " << back;
      }
    }
  }
}

TEST(Branch, FaultsThatMerelyRunCloseAreLeftAlone) {
  // Parallel to the main fault 60 away: its upper and lower border and its tips come near, none
  // ends there.
  const FaultSurface beside = FaultSurface::fromMesh(
      "beside", test::sheet(20, 4, [](double u, double v) {
        return Vector3(2000.0 * u - 1000.0, 250.0 * (0.5 - v) - 70.0, 330.0 * (0.5 - v));
      }));
  EXPECT_TRUE(FaultNetwork({mainFault(), beside}, kReach).branches().empty());
  // Farther off than the reach.
  EXPECT_TRUE(FaultNetwork({mainFault(), branchFault(1.7 * kReach)}, kReach).branches().empty());
  // Goes over the main fault with its lower border near it at one place only.
  const FaultSurface over =
      test::plane("over", {-600, -400, 300}, {1200, 1000, 0}, {60, 0, -85}, 20, 2);
  EXPECT_TRUE(FaultNetwork({mainFault(), over}, kReach).branches().empty());
}

TEST(Branch, AntitheticFaultIsExtendedDownToTheMainFault) {
  // Dips the other way and stops 40 above the main fault along its whole lower border.
  const FaultSurface antithetic =
      test::plane("antithetic", {-500, -200, 200}, {1000, 0, 0}, {0, 110, -180}, 10, 3);
  const FaultNetwork network({mainFault(), antithetic}, kReach);
  ASSERT_EQ(network.branches().size(), 1U);
  EXPECT_EQ(network.branches()[0].fault, 1);
  for (double x = -490.0; x < 490.0; x += 7.0)
    EXPECT_TRUE(network.crosses({x, -300, -20}, {x, mainY(x, -20) - 0.01, -20}) ||
                network.crosses({x, -300, 20}, {x, mainY(x, 20) - 0.01, 20}));
  expectSound(network.fault(1).mesh);
}

namespace {

std::vector<FaultSurface> drogonFaults(const std::string& domain) {
  std::vector<FaultSurface> faults;
  for (const char* name : {"F1", "F2", "F3", "F4", "F5", "F6"}) {
    const auto file = test::dataDir() / "drogon" / domain / (std::string(name) + ".pol");
    faults.push_back(FaultSurface::loft(name, test::readPol(file.string())));
    expectSound(faults.back().mesh);
  }
  return faults;
}

std::vector<std::pair<Index, Index>> pairsOf(const FaultNetwork& network) {
  std::vector<std::pair<Index, Index>> pairs;
  for (const FaultBranch& b : network.branches())
    pairs.emplace_back(b.fault, b.main_fault);
  return pairs;
}

} // namespace

TEST(Branch, OfDrogonsF6AndF2AreFound) {
  GRABEN_REQUIRE_DATA(first_file, "drogon/time/F1.pol");
  for (const std::string domain : {"time", "depth"})
    for (const double reach : {100.0, 150.0, 200.0, 300.0}) {
      const FaultNetwork network(drogonFaults(domain), reach);
      // F2 runs into F1 at its north end; F6 leaves F2 and comes back to it, sharing a stick with
      // it at either end.
      const std::vector<std::pair<Index, Index>> expected = {{1, 0}, {5, 1}, {5, 1}};
      EXPECT_EQ(pairsOf(network), expected) << domain << " " << reach;
      EXPECT_NEAR(network.branches()[0].gap, 220.0, 10.0);
      EXPECT_LT(network.branches()[1].gap, 1e-6);
      EXPECT_LT(network.branches()[2].gap, 1e-6);
      for (std::size_t i = 0; i < network.size(); ++i)
        expectSound(network.fault(i).mesh);
    }
}

TEST(Branch, OfDrogonsF2ReachesF1AtTheHorizon) {
  GRABEN_REQUIRE_DATA(first_file, "drogon/time/F1.pol");
  const FaultNetwork apart(drogonFaults("time"));
  const FaultNetwork joined(drogonFaults("time"), 150.0);
  const Vector3 top(-447.731, 4854.670, -50.972); // F2's last stick
  const Vector3 bottom(-691.096, 4901.200, -131.906);
  std::size_t open = 0;
  for (double t = 0.1; t < 0.95; t += 0.05) {
    const Vector3 from = top + t * (bottom - top);
    const Vector3 normal = apart.nearest(1, from).normal;
    const Vector3 onward =
        normal.cross(Vector3::UnitZ()).normalized(); // along strike, to the north
    ASSERT_GT(onward.y(), 0.9);
    const Vector3 across = 15.0 * normal;
    const auto main = apart.crossings(0, from, from + 600.0 * onward);
    ASSERT_FALSE(main.empty());
    const double gap = 600.0 * main.front().parameter;
    for (double d = 1.0; d < gap - 4.0; d += 2.0) {
      const Vector3 p = from + d * onward;
      if (apart.crosses(p - across, p) || apart.crosses(p, p + across))
        continue; // F1 is in the way already
      ++open;
      EXPECT_TRUE(joined.crosses(p - across, p + across)) << t << " " << d;
    }
  }
  EXPECT_GT(open, 200U);
}

TEST(Branch, OfDrogonsF6IsTightAtBothEnds) {
  GRABEN_REQUIRE_DATA(first_file, "drogon/time/F1.pol");
  const FaultNetwork network(drogonFaults("time"), 150.0);
  const auto sticks = test::readPol((test::dataDir() / "drogon/time/F6.pol").string());
  Random random(11);
  std::size_t tried = 0;
  for (const std::size_t end : {std::size_t{0}, std::size_t{16}}) {
    const Points& stick = sticks[end].points;
    for (int i = 0; i < 20000; ++i) {
      const Vector3 at = stick[0] + random.in(0.05, 0.95) * (stick[1] - stick[0]);
      const double radius = random.in(0.01, 8.0);
      const Vector3 p = at + random.point(radius);
      const Vector3 q = at + random.point(radius);
      // On F6's side of F2, one on each side of F6, and no part of F2 between them.
      if (network.side(1, p) != 1 || network.side(1, q) != 1 ||
          !network.crossings(1, p, q).empty() || network.side(5, p) * network.side(5, q) != -1)
        continue;
      ++tried;
      EXPECT_TRUE(network.crosses(p, q));
    }
  }
  EXPECT_GT(tried, 500U);
}

TEST(Branch, SeparateFaultsOfOneModelStaySeparate) {
  GRABEN_REQUIRE_DATA(first_file, "modelA4/F1fault.ts");
  std::vector<FaultSurface> faults;
  for (const char* name : {"modelA4/F1fault.ts", "modelA4/F2fault.ts"})
    faults.push_back(FaultSurface::fromMesh(
        name, test::readTsurf((test::dataDir() / name).string(), Vector3::Zero())));
  EXPECT_TRUE(FaultNetwork(faults, 100.0).branches().empty());
}
