#pragma once

#include "graben/analysis/topology.h"
#include "graben/features/tangent_planes.h"
#include "graben/surface/cut_mesh.h"
#include "graben/surface/sheet_extraction.h"

#include <Eigen/Geometry>

#include <cmath>
#include <memory>
#include <random>

namespace graben::test {

constexpr double kPi = 3.14159265358979323846;

/// Random numbers that are the same with every standard library.
class Random {
public:
  explicit Random(std::uint64_t seed)
      : engine_(seed) {}
  double uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
  }
  double normal(double sigma) {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform(0.0, 1.0)));
    return sigma * radius * std::cos(uniform(0.0, 2.0 * kPi));
  }

private:
  std::mt19937_64 engine_;
};

/// Points with oriented normals, as exact as they are made.
struct Oriented {
  Points points;
  Points normals;

  void add(const Vector3& p, const Vector3& n) {
    points.push_back(p);
    normals.push_back(n.normalized());
  }
  TangentPlanes planes() const {
    TangentPlanes planes;
    planes.centres = points;
    planes.normals = normals;
    return planes;
  }
};

/// Points spread evenly over a sphere, normals outwards.
inline Oriented sphere(std::size_t count, double radius, const Vector3& centre = Vector3::Zero()) {
  Oriented o;
  for (std::size_t i = 0; i < count; ++i) {
    const double z = 1.0 - (2.0 * static_cast<double>(i) + 1.0) / static_cast<double>(count);
    const double angle = 2.399963229728653 * static_cast<double>(i), ring = std::sqrt(1.0 - z * z);
    const Vector3 n(ring * std::cos(angle), ring * std::sin(angle), z);
    o.add(centre + radius * n, n);
  }
  return o;
}

/// A jittered grid of picks every \a spacing on z = height(x, y) over the square [-half, half]^2,
/// normals up.
template <typename Height>
Oriented sheet(double half, double spacing, const Height& height, double jitter = 0.3,
               std::uint64_t seed = 1) {
  Random random(seed);
  Oriented o;
  const double e = 1e-3 * spacing;
  for (double x = -half; x <= half + 1e-9; x += spacing)
    for (double y = -half; y <= half + 1e-9; y += spacing) {
      const double u = x + random.uniform(-jitter, jitter) * spacing,
                   v = y + random.uniform(-jitter, jitter) * spacing;
      o.add({u, v, height(u, v)}, {(height(u - e, v) - height(u + e, v)) / (2.0 * e),
                                   (height(u, v - e) - height(u, v + e)) / (2.0 * e), 1.0});
    }
  return o;
}

/// A plane fault x = shift + z / tan(dip) for y from y0 to y1 and z from -depth to depth, normal
/// towards +x.
inline FaultSurface dippingFault(double y0, double y1, double depth, double dip = 60.0,
                                 double shift = 0.0, const char* name = "fault") {
  const double run = depth / std::tan(dip * kPi / 180.0);
  TriangleMesh mesh;
  mesh.vertices = {{shift - run, y0, -depth},
                   {shift - run, y1, -depth},
                   {shift + run, y1, depth},
                   {shift + run, y0, depth}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return FaultSurface::fromMesh(name, mesh);
}

inline double areaOf(const TriangleMesh& mesh) {
  double area = 0.0;
  for (const Triangle& t : mesh.triangles) {
    const Vector3& a = mesh.vertices[static_cast<std::size_t>(t[0])];
    area += 0.5 * (mesh.vertices[static_cast<std::size_t>(t[1])] - a)
                      .cross(mesh.vertices[static_cast<std::size_t>(t[2])] - a)
                      .norm();
  }
  return area;
}

/// n x n square cells of edge \a cell in z = 0 about the origin, two triangles each, normals up.
inline TriangleMesh flatGrid(Index n, double cell) {
  TriangleMesh mesh;
  for (Index j = 0; j <= n; ++j)
    for (Index i = 0; i <= n; ++i)
      mesh.vertices.emplace_back((i - 0.5 * n) * cell, (j - 0.5 * n) * cell, 0.0);
  for (Index j = 0; j < n; ++j)
    for (Index i = 0; i < n; ++i) {
      const Index v = j * (n + 1) + i;
      mesh.triangles.push_back({v, v + 1, v + n + 2});
      mesh.triangles.push_back({v, v + n + 2, v + n + 1});
    }
  return mesh;
}

inline bool sameMesh(const TriangleMesh& a, const TriangleMesh& b) {
  return a.triangles == b.triangles && a.vertices == b.vertices && a.normals == b.normals;
}

} // namespace graben::test
