#include "graben/faults/fault_network.h"

#include "graben/core/errors.h"
#include "graben/core/threads.h"
#include "graben/faults/triangles_near.h"
#include "graben/mesh/triangle_bounds.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <limits>
#include <tuple>

using namespace graben;
using test::Random;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Crumpled sheets that fold, touch themselves and hang on shared edges.
FaultSurface crumpled(std::uint64_t seed) {
  Random random(seed);
  const Vector3 centre = random.point(40.0);
  TriangleMesh mesh = test::sheet(9, 7, [&](double u, double v) {
    return Vector3(centre + Vector3(100.0 * u - 50.0, 100.0 * v - 50.0, 0.0) + random.point(9.0));
  });
  for (int extra = 0; extra < 12; ++extra) { // fins on existing vertices: non-manifold
    const auto a = static_cast<Index>(random.below(80));
    mesh.triangles.push_back(
        {a, static_cast<Index>((a + 1) % 80), static_cast<Index>(random.below(80))});
  }
  return FaultSurface::fromMesh("crumpled", mesh);
}

FaultNetwork crumpledNetwork() {
  std::vector<FaultSurface> faults;
  for (std::uint64_t seed = 10; seed < 14; ++seed)
    faults.push_back(crumpled(seed));
  return FaultNetwork(std::move(faults));
}

/// Parameter where the segment meets the triangle (Moeller and Trumbore), or a negative number.
double bruteHit(const Points& t, const Vector3& a, const Vector3& b) {
  const Vector3 u = t[1] - t[0];
  const Vector3 v = t[2] - t[0];
  const Vector3 h = (b - a).cross(v);
  const double det = u.dot(h);
  if (det == 0.0)
    return -1.0;
  const Vector3 s = a - t[0];
  const double x = s.dot(h) / det;
  const Vector3 q = s.cross(u);
  const double y = (b - a).dot(q) / det;
  const double parameter = v.dot(q) / det;
  return x < 0.0 || y < 0.0 || x + y > 1.0 || parameter > 1.0 ? -1.0 : parameter;
}

struct Segment {
  Vector3 a, b;
};

std::vector<Segment> segments(std::size_t count) {
  Random random(77);
  std::vector<Segment> result(count);
  for (Segment& s : result) {
    s.a = random.point(90.0);
    s.b = s.a + random.point(random.in(1.0, 80.0));
  }
  return result;
}

double relief(double x, double y) {
  return 20.0 * std::sin(0.05 * x) * std::cos(0.04 * y);
}

} // namespace

TEST(FaultNetwork, CrossingsAgreeWithBruteForce) {
  const FaultNetwork network = crumpledNetwork();
  std::size_t met = 0;
  for (const Segment& s : segments(3000)) {
    double first = kInfinity;
    Index first_fault = -1;
    for (std::size_t f = 0; f < network.size(); ++f) {
      const TriangleMesh& mesh = network.fault(f).mesh;
      std::vector<double> expected;
      for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        if (const double p = bruteHit(test::corners(mesh, t), s.a, s.b); p >= 0.0) {
          expected.push_back(p);
          if (p < first) {
            first = p;
            first_fault = static_cast<Index>(f);
          }
        }
      std::sort(expected.begin(), expected.end());
      const auto found = network.crossings(f, s.a, s.b);
      ASSERT_EQ(found.size(), expected.size());
      for (std::size_t k = 0; k < found.size(); ++k) {
        EXPECT_NEAR(found[k].parameter, expected[k], 1e-9);
        EXPECT_LT((found[k].point - (s.a + found[k].parameter * (s.b - s.a))).norm(), 1e-9);
        const Vector3 n = test::normalOf(mesh, static_cast<std::size_t>(found[k].triangle));
        EXPECT_EQ(found[k].direction, n.dot(s.b - s.a) > 0.0 ? 1 : -1);
      }
    }
    const auto crossing = network.firstCrossing(s.a, s.b);
    ASSERT_EQ(crossing.has_value(), first_fault >= 0);
    ASSERT_EQ(network.crosses(s.a, s.b), first_fault >= 0);
    ASSERT_EQ(network.crosses(s.b, s.a), first_fault >= 0);
    if (crossing) {
      ++met;
      EXPECT_EQ(crossing->fault, first_fault);
      EXPECT_NEAR(crossing->parameter, first, 1e-9);
      EXPECT_TRUE(network.mayTouch({s.a.cwiseMin(s.b), s.a.cwiseMax(s.b)}));
    }
  }
  EXPECT_GT(met, 300U);
}

TEST(FaultNetwork, NearestAgreesWithBruteForce) {
  const FaultNetwork network = crumpledNetwork();
  Random random(5);
  for (int i = 0; i < 1500; ++i) {
    const Vector3 p = random.point(140.0);
    double best = kInfinity;
    for (std::size_t f = 0; f < network.size(); ++f) {
      double own = kInfinity;
      const TriangleMesh& mesh = network.fault(f).mesh;
      for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const Points c = test::corners(mesh, t);
        own = std::min(own, (nearestPointOnTriangle(p, c[0], c[1], c[2]).point - p).norm());
      }
      EXPECT_NEAR(network.nearest(f, p).distance, own, 1e-9);
      best = std::min(best, own);
    }
    const FaultPoint found = network.nearest(p);
    EXPECT_NEAR(found.distance, best, 1e-9);
    EXPECT_NEAR((found.point - p).norm(), best, 1e-9);
    EXPECT_EQ(found.fault, network.nearest(p, best * (1.0 + 1e-9)).fault);
    EXPECT_EQ(network.nearest(p, best * (1.0 - 1e-9)).fault, -1);
    const bool touches =
        network.mayTouch({p - Vector3::Constant(best), p + Vector3::Constant(best)});
    EXPECT_TRUE(touches);
  }
}

TEST(TrianglesNear, AreThoseWhoseBoxesMayTouchAFault) {
  const FaultNetwork network = crumpledNetwork();
  Random random(9);
  TriangleMesh mesh;
  for (int i = 0; i < 3000; ++i) {
    const Vector3 at = random.point(200.0);
    for (int e = 0; e < 3; ++e)
      mesh.vertices.push_back(at + random.point(3.0));
    mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  for (const double reach : {0.0, 5.0}) {
    std::vector<Index> expected;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const Bounds box = boundsOf(mesh, mesh.triangles[t]);
      if (network.mayTouch({box.low - Vector3::Constant(reach), box.high + Vector3::Constant(reach)}))
        expected.push_back(static_cast<Index>(t));
    }
    EXPECT_GT(expected.size(), 10U);
    EXPECT_LT(expected.size(), 2000U);
    EXPECT_EQ(trianglesNear(network, mesh, reach), expected);
    EXPECT_EQ(trianglesNear(network, mesh, reach, 3), expected);
  }
  EXPECT_TRUE(trianglesNear(FaultNetwork(), mesh, 5.0).empty());
}

TEST(FaultNetwork, SideOfAPlaneIsTheSignOfItsEquation) {
  const Vector3 strike(900, 200, 0);
  const Vector3 dip(-60, 240, -500);
  const FaultNetwork network({test::plane("plane", {-450, -200, 250}, strike, dip)});
  const Vector3 normal = (dip.cross(strike)).z() > 0.0 ? dip.cross(strike) : strike.cross(dip);
  Random random(6);
  for (int i = 0; i < 2000; ++i) {
    const Vector3 p = random.point(1000.0);
    const int expected = normal.dot(p - Vector3(-450, -200, 250)) > 0.0 ? 1 : -1;
    EXPECT_EQ(network.side(0, p), expected);
    const Vector3 inside =
        Vector3(-450, -200, 250) + random.in(0.1, 0.9) * strike + random.in(0.1, 0.9) * dip;
    const FaultPoint above = network.nearest(inside + 3.0 * normal.normalized());
    EXPECT_EQ(above.side, 1);
    EXPECT_FALSE(above.at_border);
    EXPECT_NEAR(above.distance, 3.0, 1e-9);
    EXPECT_LT((above.normal - normal.normalized()).norm(), 1e-12);
  }
  EXPECT_EQ(network.side(0, network.fault(0).mesh.vertices[7]), 0);
  EXPECT_TRUE(network.nearest(Vector3(-800, -300, 300)).at_border);
  EXPECT_TRUE(network.nearest(Vector3(-450, -200, 250) + 0.53 * strike - 0.3 * dip).at_border);
}

TEST(FaultNetwork, SideOfAWavySurfaceIsRightOnItsRidgesAndInItsValleys) {
  const FaultNetwork network(
      {FaultSurface::fromMesh("wavy", test::sheet(40, 40, [](double u, double v) {
                                const double x = 400.0 * u - 200.0;
                                const double y = 400.0 * v - 200.0;
                                return Vector3(x, y, relief(x, y));
                              }))});
  const TriangleMesh& mesh = network.fault(0).mesh;
  Random random(7);
  for (int i = 0; i < 5000; ++i) {
    const Vector3 p(random.in(-150, 150), random.in(-150, 150), random.in(-60, 60));
    const auto up = network.crossings(0, p, p + Vector3(0, 0, 500));
    EXPECT_EQ(network.side(0, p), up.empty() ? 1 : -1);
  }
  // Straight off every inner corner, where the faces around it disagree most.
  for (const Vector3& v : mesh.vertices)
    if (v.head<2>().cwiseAbs().maxCoeff() < 199.0) {
      EXPECT_EQ(network.side(0, v + Vector3(0, 0, 0.01)), 1);
      EXPECT_EQ(network.side(0, v - Vector3(0, 0, 0.01)), -1);
    }
}

TEST(FaultNetwork, SideIsRightOffASharpPeakWithUnevenTriangles) {
  // A spike with three wide faces and a crowd of narrow ones: a plain mean of its faces points to
  // the crowd.
  TriangleMesh spike;
  spike.vertices = {{0, 0, 0}};
  for (int k = 0; k < 40; ++k) {
    const double angle = k < 37 ? 0.01 * k : 0.36 + (k - 36) * 1.48;
    spike.vertices.push_back({std::cos(angle), std::sin(angle), -4.0});
  }
  for (Index k = 1; k <= 40; ++k)
    spike.triangles.push_back({0, k, static_cast<Index>(k % 40 + 1)});
  const FaultNetwork network({FaultSurface::fromMesh("spike", spike)});
  Random random(8);
  std::size_t at_peak = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vector3 p(random.in(-2, 2), random.in(-2, 2), random.in(0.01, 1.0));
    EXPECT_EQ(network.side(0, p), 1) << p.transpose();
    at_peak += network.nearest(p).point.isZero(0.0);
    EXPECT_EQ(network.side(0, Vector3(0.02 * p.x(), 0.02 * p.y(), -1.0)), -1);
  }
  EXPECT_GT(at_peak, 1000U);
}

TEST(FaultNetwork, ParallelQueriesEqualSerialOnes) {
  const FaultNetwork network = crumpledNetwork();
  const std::vector<Segment> all = segments(4000);
  using Answer = std::tuple<bool, double, Index, Index, double, int>;
  const auto answers = [&](unsigned threads) {
    std::vector<Answer> result(all.size());
    parallelFor(all.size(), 16, threads, [&](std::size_t i) {
      const auto first = network.firstCrossing(all[i].a, all[i].b);
      const FaultPoint near = network.nearest(all[i].a);
      result[i] = {network.crosses(all[i].a, all[i].b),
                   first ? first->parameter : -1.0,
                   near.fault,
                   near.triangle,
                   near.distance,
                   near.side};
    });
    return result;
  };
  EXPECT_EQ(answers(1), answers(4));
}

TEST(FaultNetwork, EmptyNetworkAndBadPointsMeetNothing) {
  const FaultNetwork empty;
  EXPECT_TRUE(empty.empty());
  EXPECT_FALSE(empty.crosses({0, 0, -1}, {0, 0, 1}));
  EXPECT_FALSE(empty.firstCrossing({0, 0, -1}, {0, 0, 1}));
  EXPECT_EQ(empty.nearest({0, 0, 0}).fault, -1);
  EXPECT_FALSE(empty.mayTouch({{-1, -1, -1}, {1, 1, 1}}));

  const FaultNetwork network({test::plane("plane", {-5, -5, 0}, {10, 0, 0}, {0, 10, 0})});
  EXPECT_TRUE(network.crosses({0, 0, -1}, {0, 0, 1}));
  EXPECT_TRUE(network.crosses({0, 0, 0}, {0, 0, 1})); // closed: an end on the fault meets it
  EXPECT_FALSE(network.crosses({0, 0, 0.001}, {0, 0, 1}));
  const Vector3 bad(std::numeric_limits<double>::quiet_NaN(), 0, 0);
  EXPECT_FALSE(network.crosses(bad, {0, 0, 1}));
  EXPECT_EQ(network.nearest(bad).fault, -1);
  EXPECT_EQ(network.side(0, bad), 0);
}

TEST(FaultNetwork, RefusesFaultsItCannotUse) {
  EXPECT_THROW(FaultNetwork({FaultSurface{"empty", {}}}), InvalidInputError);
  FaultSurface bad = test::plane("bad", {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  EXPECT_THROW(FaultNetwork({bad}, -1.0), InvalidInputError);
  bad.mesh.vertices[0].x() = kInfinity;
  EXPECT_THROW(FaultNetwork({bad}), InvalidInputError);
}
