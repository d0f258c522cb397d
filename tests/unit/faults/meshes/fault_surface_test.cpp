#include "graben/faults/fault_surface.h"

#include "graben/core/errors.h"
#include "graben/mesh/adjacency.h"
#include "graben/mesh/normals.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <limits>

using namespace graben;
using test::Random;

namespace {

TriangleMesh soup(const TriangleMesh& mesh, Random& random) {
  TriangleMesh out;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto first = static_cast<Index>(out.vertices.size());
    for (const Vector3& p : test::corners(mesh, t))
      out.vertices.push_back(p);
    out.triangles.push_back({first, first + 1, first + 2});
    if (random.in(0.0, 1.0) < 0.5)
      std::swap(out.triangles.back()[0], out.triangles.back()[1]);
  }
  return out;
}

Vector3 ramp(double u, double v) {
  return {1000.0 * u, 300.0 * v, -400.0 * v + 30.0 * std::sin(9.0 * u)};
}

std::size_t nonManifoldHalfEdges(const TriangleMesh& mesh) {
  const EdgeAdjacency adjacency(mesh);
  std::size_t count = 0;
  for (std::size_t h = 0; h < 3 * mesh.triangles.size(); ++h)
    count += adjacency.twin(static_cast<Index>(h)) == EdgeAdjacency::kNonManifold;
  return count;
}

} // namespace

TEST(FaultSurface, JoinsASoupIntoOneOrientedSurfaceWithNormalsUp) {
  Random random(1);
  const TriangleMesh clean = test::sheet(12, 5, ramp);
  const FaultSurface fault = FaultSurface::fromMesh("soup", soup(clean, random));
  EXPECT_EQ(fault.mesh.vertices.size(), clean.vertices.size());
  EXPECT_EQ(fault.mesh.triangles.size(), clean.triangles.size());
  EXPECT_EQ(nonManifoldHalfEdges(fault.mesh), 0U);
  for (std::size_t t = 0; t < fault.mesh.triangles.size(); ++t)
    EXPECT_GT(test::normalOf(fault.mesh, t).z(), 0.0);
}

TEST(FaultSurface, WeldJoinsVerticesCloserThanTheDistanceOnly) {
  Random random(2);
  TriangleMesh mesh = soup(test::sheet(6, 3, ramp), random);
  for (Vector3& p : mesh.vertices)
    p += random.point(0.1);
  EXPECT_EQ(FaultSurface::fromMesh("exact", mesh).mesh.vertices.size(), 3U * 36U);
  EXPECT_EQ(FaultSurface::fromMesh("welded", mesh, 1.0).mesh.vertices.size(), 7U * 4U);
}

TEST(FaultSurface, DropsWhatIsNoTriangle) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}, {nan, 0, 0}, {0.0, -0.0, 0.0}};
  mesh.triangles = {{0, 1, 2}, {0, 1, 3}, {0, 0, 1}, {0, 1, 4}, {0, 1, 99}, {-1, 1, 2}, {5, 2, 1}};
  const FaultSurface fault = FaultSurface::fromMesh("few", mesh);
  ASSERT_EQ(fault.mesh.triangles.size(), 1U);
  EXPECT_EQ(fault.mesh.vertices.size(), 3U);
  EXPECT_THROW(FaultSurface::fromMesh("none", TriangleMesh()), InvalidInputError);
  mesh.triangles = {{0, 1, 3}};
  EXPECT_THROW(FaultSurface::fromMesh("flat", mesh), InvalidInputError);
  EXPECT_THROW(FaultSurface::fromMesh("bad weld", mesh, nan), InvalidInputError);
}

TEST(FaultSurface, UprightPartsAgreeWithEachOther) {
  for (const bool turned : {false, true}) {
    TriangleMesh mesh;
    for (int part = 0; part < 3; ++part) {
      TriangleMesh piece = test::sheet(4, 4, [part](double u, double v) {
        // leaning a little to one side or the other: up alone would turn the parts against each
        // other
        return Vector3(1000.0 * part + 900.0 * u, (part == 1 ? 10.0 : -4.0) * v, -500.0 * v);
      });
      if (turned == (part == 2))
        for (Triangle& t : piece.triangles)
          std::swap(t[0], t[1]);
      append(mesh, piece);
    }
    const FaultSurface fault = FaultSurface::fromMesh("upright", mesh);
    const double first = test::normalOf(fault.mesh, 0).y();
    EXPECT_GT(first, 0.0); // up for the part that leans most and so is the largest
    for (std::size_t t = 0; t < fault.mesh.triangles.size(); ++t)
      EXPECT_GT(test::normalOf(fault.mesh, t).y() * first, 0.0);
  }
}

TEST(FaultSurface, PartsWithAClearDipPointUpEach) {
  TriangleMesh mesh = test::sheet(4, 4, [](double u, double v) { return Vector3(u, v, -2.0 * v); });
  append(mesh, test::sheet(4, 4, [](double u, double v) { return Vector3(u, 5.0 - v, -2.0 * v); }));
  const FaultSurface fault = FaultSurface::fromMesh("conjugate", mesh);
  for (std::size_t t = 0; t < fault.mesh.triangles.size(); ++t)
    EXPECT_GT(test::normalOf(fault.mesh, t).z(), 0.0);
}

TEST(FaultSurface, OrientsPatchesAcrossNonManifoldEdgesAndMoebiusStripsWithoutHanging) {
  TriangleMesh fins; // four sheets on one edge
  fins.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 1}, {0, -1, 1}, {0, 1, -1}, {0, -1, -1}};
  fins.triangles = {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}, {0, 1, 5}};
  EXPECT_EQ(FaultSurface::fromMesh("fins", fins).mesh.triangles.size(), 4U);
  const TriangleMesh strip = test::sheet(24, 2, [](double u, double v) {
    const double a = 2.0 * M_PI * u;
    const double w = v - 0.5;
    return Vector3((2.0 + w * std::cos(a / 2)) * std::cos(a),
                   (2.0 + w * std::cos(a / 2)) * std::sin(a), w * std::sin(a / 2));
  });
  EXPECT_EQ(FaultSurface::fromMesh("moebius", strip, 1e-6).mesh.triangles.size(),
            strip.triangles.size());
}
