#include "graben/mesh/nearest_triangles.h"

#include "graben/core/errors.h"
#include "graben/mesh/triangle_bvh.h"
#include "search/inside_distance.h"
#include "search/triangle_runs.h"
#include "unit/mesh/meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace graben {
namespace {

/// Points of a wavy sheet of n x n cells with that much noise in z, row by row in short rows, so that those that follow each other are near.
Points sheetPoints(std::mt19937_64& generator, std::size_t count, double noise) {
  Points points;
  for (std::size_t i = 0; i < count; ++i) {
    const Vector3 r = test::randomPoint(generator, 0.0, 1.0);
    const double x = 0.5 * static_cast<double>(i % 8) + 0.4 * r.x();
    const double y = 0.06 * static_cast<double>(i / 8) + 0.05 * r.y();
    points.emplace_back(x, y, std::sin(x) + noise * (r.z() - 0.5));
  }
  return points;
}

TriangleMesh sheet(std::size_t n, double size, bool thin) {
  TriangleMesh mesh;
  for (std::size_t j = 0; j <= n; ++j)
    for (std::size_t i = 0; i <= n; ++i) {
      const double x = size * static_cast<double>(i);
      mesh.vertices.emplace_back(x, (thin ? 1e-6 : 1.0) * size * static_cast<double>(j), std::sin(x));
    }
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t i = 0; i < n; ++i) {
      const auto a = static_cast<Index>(j * (n + 1) + i);
      const auto above = static_cast<Index>(a + static_cast<Index>(n) + 1);
      mesh.triangles.push_back({a, a + 1, above});
      mesh.triangles.push_back({a + 1, above + 1, above});
    }
  return mesh;
}

void expectSameAsOneByOne(const TriangleMesh& mesh, const Points& points) {
  const TriangleBvh bvh(mesh);
  std::vector<double> distances(points.size());
  std::vector<Index> triangles(points.size());
  NearestTriangles(mesh).find(points.data(), points.size(), distances.data(), triangles.data());
  for (std::size_t p = 0; p < points.size(); ++p) {
    const MeshPoint one = bvh.nearest(points[p]);
    ASSERT_EQ(triangles[p], one.triangle) << p;
    ASSERT_EQ(distances[p], one.distance) << p;
  }
}

TEST(NearestTriangles, PicksOnASheet) {
  std::mt19937_64 generator(1);
  for (const double noise : {0.0, 1e-9, 0.05, 0.5, 5.0})
    for (const double size : {0.1, 0.3})
      expectSameAsOneByOne(sheet(30, size, false), sheetPoints(generator, 500, noise));
}

TEST(NearestTriangles, FarFromTheOrigin) {
  std::mt19937_64 generator(2);
  const Vector3 far(6e6, 6e6, -3e3);
  TriangleMesh mesh = sheet(30, 0.2, false);
  Points points = sheetPoints(generator, 500, 0.1);
  for (Vector3& p : mesh.vertices)
    p += far;
  for (Vector3& p : points)
    p += far;
  expectSameAsOneByOne(mesh, points);
}

TEST(NearestTriangles, ThinTriangles) {
  std::mt19937_64 generator(3);
  expectSameAsOneByOne(sheet(30, 0.2, true), sheetPoints(generator, 300, 0.1));
}

TEST(NearestTriangles, SoupAndScatteredPoints) {
  std::mt19937_64 generator(4);
  for (const double cube : {1e-6, 1.0, 1e6}) {
    Points points;
    for (int i = 0; i < 300; ++i)
      points.push_back(test::randomPoint(generator, -1.5 * cube, 1.5 * cube));
    expectSameAsOneByOne(test::soup(generator, 500, cube, 0.2 * cube), points);
    expectSameAsOneByOne(test::soup(generator, 3, cube, 0.2 * cube), points);
  }
}

TEST(NearestTriangles, PointsOnCornersAndEdgesTakeTheLowestTriangle) {
  const TriangleMesh mesh = sheet(20, 0.25, false);
  Points points = mesh.vertices;
  for (const Triangle& t : mesh.triangles)
    points.push_back(0.5 * (mesh.vertices[static_cast<std::size_t>(t[0])] + mesh.vertices[static_cast<std::size_t>(t[1])]));
  expectSameAsOneByOne(mesh, points);
}

TEST(NearestTriangles, DistancesOverTheInsideAreExactToTheLastBit) {
  std::mt19937_64 generator(9);
  const TriangleMesh mesh = test::soup(generator, 400, 3.0, 2.0);
  const detail::TriangleRuns runs(mesh, 1);
  Points points;
  std::vector<Index> triangles;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    points.push_back(mesh.vertices[static_cast<std::size_t>(mesh.triangles[t][0])] + test::randomPoint(generator, -1.0, 1.0));
    triangles.push_back(static_cast<Index>(t));
  }
  triangles[5] = -1;
  std::vector<double> squared(points.size());
  detail::distancesInside(runs.view(mesh), points.front().data(), triangles.data(), points.size() - 3, squared.data());
  std::size_t inside = 0;
  for (std::size_t t = 0; t < points.size() - 3; ++t) {
    const auto corner = [&](std::size_t e) { return mesh.vertices[static_cast<std::size_t>(mesh.triangles[t][e])]; };
    const TrianglePoint nearest = nearestPointOnTriangle(points[t], corner(0), corner(1), corner(2));
    const bool over = triangles[t] >= 0 && nearest.barycentric.minCoeff() > 0.0;
    ASSERT_EQ(squared[t], over ? (nearest.point - points[t]).squaredNorm() : -1.0) << t;
    inside += over ? 1 : 0;
  }
  EXPECT_GT(inside, 20U);
}

TEST(NearestTriangles, OfAMeshInNoOrder) {
  std::mt19937_64 generator(6);
  TriangleMesh mesh = sheet(120, 0.05, false);
  for (std::size_t t = mesh.triangles.size(); t > 1; --t)
    std::swap(mesh.triangles[t - 1], mesh.triangles[generator() % t]);
  expectSameAsOneByOne(mesh, sheetPoints(generator, 500, 0.05));
}

TEST(NearestTriangles, OfAMeshWithSmallAndLargeTriangles) {
  std::mt19937_64 generator(7);
  TriangleMesh mesh = sheet(6, 1.0, false);
  const TriangleMesh fine = sheet(60, 0.03, false);
  for (const Triangle& t : fine.triangles)
    mesh.triangles.push_back({t[0] + static_cast<Index>(mesh.vertices.size()), t[1] + static_cast<Index>(mesh.vertices.size()),
                              t[2] + static_cast<Index>(mesh.vertices.size())});
  mesh.vertices.insert(mesh.vertices.end(), fine.vertices.begin(), fine.vertices.end());
  expectSameAsOneByOne(mesh, sheetPoints(generator, 500, 0.1));
}

TEST(NearestTriangles, AreTheSameForEveryNumberOfThreads) {
  std::mt19937_64 generator(8);
  const TriangleMesh mesh = sheet(80, 0.05, false);
  const Points points = sheetPoints(generator, 300, 0.2);
  const auto find = [&](unsigned threads) {
    std::vector<double> distances(points.size());
    std::vector<Index> triangles(points.size());
    NearestTriangles(mesh, threads).find(points.data(), points.size(), distances.data(), triangles.data());
    return std::make_pair(distances, triangles);
  };
  EXPECT_EQ(find(1), find(3));
}

TEST(NearestTriangles, NeedAValidMesh) {
  TriangleMesh broken = sheet(3, 1.0, false);
  broken.triangles[4][1] = 99;
  EXPECT_THROW(NearestTriangles{broken}, InvalidInputError);
}

TEST(NearestTriangles, PointsThatAreNotFiniteOrVeryFar) {
  std::mt19937_64 generator(5);
  Points points = sheetPoints(generator, 200, 0.1);
  points[3].x() = std::numeric_limits<double>::quiet_NaN();
  points[70].z() = std::numeric_limits<double>::infinity();
  points[100] *= 1e8;
  points[101] *= 1e200;
  expectSameAsOneByOne(sheet(30, 0.2, false), points);
}

TEST(NearestTriangles, NothingToFind) {
  const TriangleMesh mesh;
  const Points points(3, Vector3::Zero());
  std::vector<double> distances(3);
  std::vector<Index> triangles(3);
  NearestTriangles(mesh).find(points.data(), points.size(), distances.data(), triangles.data());
  EXPECT_EQ(triangles, std::vector<Index>(3, -1));
  EXPECT_TRUE(std::isinf(distances[2]));
}

} // namespace
} // namespace graben
