#include "graben/mesh/triangle_bvh.h"

#include "graben/core/errors.h"
#include "unit/mesh/meshes.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace graben {
namespace {

/// A mesh of each triangle alone answers for the brute force.
std::vector<TriangleBvh> singles(const TriangleMesh& mesh) {
  std::vector<TriangleBvh> result;
  for (const Triangle& t : mesh.triangles) {
    TriangleMesh one;
    one.vertices = mesh.vertices;
    one.triangles = {t};
    removeUnreferencedVertices(one);
    result.emplace_back(one);
  }
  return result;
}

class BvhAgainstBruteForce : public testing::TestWithParam<int> {
protected:
  BvhAgainstBruteForce()
      : generator_(static_cast<std::uint64_t>(GetParam())) {
    const double cube = GetParam() % 2 == 0 ? 1.0 : 1e4;
    mesh_ = test::soup(generator_, 30 * GetParam() + 1, cube, cube * 0.2);
    cube_ = cube;
  }
  std::mt19937_64 generator_;
  TriangleMesh mesh_;
  double cube_ = 1.0;
};

TEST_P(BvhAgainstBruteForce, Nearest) {
  const TriangleBvh bvh(mesh_);
  for (int i = 0; i < 300; ++i) {
    const Vector3 p = test::randomPoint(generator_, -1.5 * cube_, 1.5 * cube_);
    const double reach = i % 3 == 0 ? 0.1 * cube_ : std::numeric_limits<double>::infinity();
    Index best = -1;
    double best2 = std::numeric_limits<double>::infinity();
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      const TrianglePoint at = nearestPointOnTriangle(
          p, mesh_.vertices[3 * t], mesh_.vertices[3 * t + 1], mesh_.vertices[3 * t + 2]);
      const double d2 = (at.point - p).squaredNorm();
      if (d2 < best2 && std::sqrt(d2) <= reach) {
        best2 = d2;
        best = static_cast<Index>(t);
      }
    }
    const MeshPoint found = bvh.nearest(p, reach);
    ASSERT_EQ(found.triangle, best);
    ASSERT_EQ(found.distance, std::sqrt(best2));
  }
}

TEST_P(BvhAgainstBruteForce, Segments) {
  const TriangleBvh bvh(mesh_);
  const std::vector<TriangleBvh> each = singles(mesh_);
  int crossed = 0;
  for (int i = 0; i < 300; ++i) {
    const Vector3 a = test::randomPoint(generator_, -1.2 * cube_, 1.2 * cube_);
    Vector3 b = test::randomPoint(generator_, -1.2 * cube_, 1.2 * cube_);
    if (i % 5 == 0)
      b = a + Vector3::Unit(i % 3) * cube_; // along an axis
    std::vector<SegmentHit> expected;
    for (std::size_t t = 0; t < each.size(); ++t)
      if (const auto hit = each[t].firstHit(a, b))
        expected.push_back({static_cast<Index>(t), hit->parameter, hit->point});
    std::stable_sort(
        expected.begin(), expected.end(),
        [](const SegmentHit& p, const SegmentHit& q) { return p.parameter < q.parameter; });
    const std::vector<SegmentHit> all = bvh.allHits(a, b);
    ASSERT_EQ(all.size(), expected.size());
    for (std::size_t h = 0; h < all.size(); ++h) {
      ASSERT_EQ(all[h].triangle, expected[h].triangle);
      ASSERT_NEAR(all[h].parameter, expected[h].parameter,
                  1e-9); // the tolerance depends on the mesh's size
    }
    ASSERT_EQ(bvh.hits(a, b), !expected.empty());
    const auto first = bvh.firstHit(a, b);
    ASSERT_EQ(first.has_value(), !expected.empty());
    if (first) {
      ASSERT_EQ(first->triangle, expected.front().triangle);
      ++crossed;
    }
  }
  EXPECT_GT(crossed, GetParam() > 2 ? 30 : -1);
}

TEST_P(BvhAgainstBruteForce, Boxes) {
  const TriangleBvh bvh(mesh_);
  for (int i = 0; i < 100; ++i) {
    Bounds box;
    box.extend(test::randomPoint(generator_, -cube_, cube_));
    box.extend(box.low + Vector3::Constant(0.3 * cube_));
    std::vector<Index> found;
    bvh.forEachInBox(box, [&found](Index t) {
      found.push_back(t);
      return true;
    });
    std::sort(found.begin(), found.end());
    std::vector<Index> expected;
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
      if (boundsOf({mesh_.vertices[3 * t], mesh_.vertices[3 * t + 1], mesh_.vertices[3 * t + 2]})
              .overlaps(box))
        expected.push_back(static_cast<Index>(t));
    ASSERT_EQ(found, expected);
    ASSERT_EQ(bvh.mayTouch(box), !expected.empty());
  }
}

INSTANTIATE_TEST_SUITE_P(Soups, BvhAgainstBruteForce, testing::Values(0, 1, 2, 5, 10, 15),
                         [](const auto& tested) { return "Of" + std::to_string(30 * tested.param + 1) + "Triangles"; });

TEST(TriangleBvh, PointsThatNothingPartsSeeEachOther) {
  std::mt19937_64 generator(7);
  const TriangleBvh bvh(test::soup(generator, 60, 1.0, 0.3));
  int together = 0;
  int parted = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vector3 centre = test::randomPoint(generator, -1.0, 1.0);
    Points points;
    for (int k = 0; k < 5; ++k)
      points.push_back(centre + test::randomPoint(generator, -0.06, 0.06));
    bool hit = false;
    for (const Vector3& a : points)
      for (const Vector3& b : points)
        hit = hit || bvh.hits(a, b);
    const bool may_part = bvh.mayPart(points.data(), points.size());
    ASSERT_TRUE(may_part || !hit);
    together += may_part ? 0 : 1;
    parted += hit ? 1 : 0;
  }
  EXPECT_GT(together, 500);
  EXPECT_GT(parted, 20);
  const Points touching = {{0.2, 0.2, 0.0}, {0.2, 0.2, 1.0}};
  EXPECT_TRUE(TriangleBvh(test::gridMesh(1)).mayPart(touching.data(), touching.size())); // an end on the mesh meets it
  EXPECT_FALSE(TriangleBvh().mayPart(touching.data(), touching.size()));
}

TEST(TriangleBvh, TiesGoToTheLowestTriangle) {
  // The same triangles again and again: every query is a tie.
  TriangleMesh mesh = test::gridMesh(3);
  const TriangleMesh once = mesh;
  for (int i = 0; i < 20; ++i)
    mesh.triangles.insert(mesh.triangles.end(), once.triangles.begin(), once.triangles.end());
  const TriangleBvh bvh(mesh);
  std::mt19937_64 generator(3);
  for (int i = 0; i < 200; ++i) {
    const Vector3 p = test::randomPoint(generator, -0.5, 3.5);
    EXPECT_LT(bvh.nearest(p).triangle, 18);
    const auto hit = bvh.firstHit({p.x(), p.y(), -5}, {p.x(), p.y(), 5});
    EXPECT_LT(hit ? hit->triangle : 0, 18);
  }
  EXPECT_EQ(bvh.nearest({1, 1, 2}).triangle, 0); // a corner of six triangles
}

TEST(TriangleBvh, AnswersNothingToNonsense) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const TriangleBvh nothing;
  EXPECT_TRUE(nothing.empty());
  EXPECT_TRUE(nothing.bounds().empty());
  EXPECT_EQ(nothing.nearest({0, 0, 0}).triangle, -1);
  EXPECT_FALSE(nothing.hits({0, 0, -1}, {0, 0, 1}));
  EXPECT_FALSE(nothing.mayTouch(boundsOf({{0, 0, 0}})));
  const TriangleBvh bvh(test::gridMesh(4));
  EXPECT_EQ(bvh.nearest({nan, 0, 0}).triangle, -1);
  EXPECT_EQ(bvh.nearest({0, 0, 0}, nan).triangle, -1);
  EXPECT_EQ(bvh.nearest({0, 0, 3}, 2.0).triangle, -1);
  EXPECT_EQ(bvh.nearest({0, 0, 3}, 3.0).distance, 3.0);
  EXPECT_FALSE(bvh.hits({0, 0, -1}, {0, nan, 1}));
  EXPECT_TRUE(bvh.allHits({nan, 0, 0}, {0, 0, 1}).empty());
  EXPECT_FALSE(bvh.mayTouch(Bounds()));
  TriangleMesh broken = test::gridMesh(1);
  broken.triangles[0][1] = 77;
  EXPECT_THROW(TriangleBvh{broken}, InvalidInputError);
}

/// A wavy grid of 20,000 triangles, enough for several subtrees, at coordinates as of a map.
TriangleMesh wavyGrid() {
  TriangleMesh mesh = test::gridMesh(100, 20.0);
  for (Vector3& v : mesh.vertices)
    v += Vector3(4.5e5, 6.1e6, 15.0 * std::sin(0.01 * v.x()) * std::cos(0.013 * v.y()));
  return mesh;
}

TEST(TriangleBvh, ALargeMeshIsSearchedWhole) {
  const TriangleMesh mesh = wavyGrid();
  const TriangleBvh bvh(mesh);
  std::mt19937_64 generator(11);
  for (int i = 0; i < 60; ++i) {
    const Vector3 p = mesh.vertices[0] + test::randomPoint(generator, -200.0, 2200.0).cwiseProduct(Vector3(1, 1, 0.02));
    Index best = -1;
    double best2 = std::numeric_limits<double>::infinity();
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto at = [&](std::size_t e) { return mesh.vertices[static_cast<std::size_t>(mesh.triangles[t][e])]; };
      const double d2 = (nearestPointOnTriangle(p, at(0), at(1), at(2)).point - p).squaredNorm();
      if (d2 < best2) {
        best2 = d2;
        best = static_cast<Index>(t);
      }
    }
    ASSERT_EQ(bvh.nearest(p).triangle, best);
    ASSERT_EQ(bvh.nearest(p).distance, std::sqrt(best2));
    const bool beside = p.x() < 4.5e5 || p.y() < 6.1e6 || p.x() > 4.52e5 || p.y() > 6.102e6;
    ASSERT_EQ(bvh.allHits(p - Vector3(0, 0, 100), p + Vector3(0, 0, 100)).size(), beside ? 0U : 1U);
  }
}

TEST(TriangleBvh, IsTheSameForEveryNumberOfThreads) {
  const TriangleMesh mesh = wavyGrid();
  const auto visited = [&mesh](unsigned threads) {
    std::vector<Index> order;
    const TriangleBvh bvh(mesh, threads);
    bvh.forEachInBox(bvh.bounds(), [&order](Index t) {
      order.push_back(t);
      return true;
    });
    return order;
  };
  const std::vector<Index> order = visited(1);
  EXPECT_EQ(order.size(), mesh.triangles.size());
  EXPECT_EQ(visited(4), order);
}

TEST(TriangleBvh, ManyTrianglesInOnePlaceAreNoTrouble) {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles.assign(5000, {0, 1, 2});
  const TriangleBvh bvh(mesh);
  EXPECT_EQ(bvh.nearest({0.1, 0.1, 0.5}).triangle, 0);
  EXPECT_EQ(bvh.firstHit({0.1, 0.1, 0.5}, {0.1, 0.1, -0.5})->triangle, 0);
}

TEST(TriangleBvh, AGeometricSeriesStaysShallow) {
  TriangleMesh mesh;
  double x = 1e-150;
  for (Index i = 0; i < 1900;
       ++i, x *= 1.4) { // to 1e127; halving by space alone would be hundreds deep
    const Index v = 3 * i;
    mesh.vertices.emplace_back(x, 0, 0);
    mesh.vertices.emplace_back(1.1 * x, 0, 0);
    mesh.vertices.emplace_back(x, x, 0);
    mesh.triangles.push_back({v, v + 1, v + 2});
  }
  const TriangleBvh bvh(mesh);
  EXPECT_EQ(bvh.nearest({0, 0, 0}).triangle, 0);
  EXPECT_EQ(bvh.nearest({1e130, 0, 0}).triangle, 1899);
}

} // namespace
} // namespace graben
