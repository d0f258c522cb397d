#pragma once

#include "graben/faults/fault_surface.h"

#include <Eigen/Geometry>

#include <cmath>
#include <functional>
#include <random>

namespace graben::test {

/// A number in [low, high) that is the same with every standard library.
class Random {
public:
  explicit Random(std::uint64_t seed)
      : engine_(seed) {}
  double in(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1.0p-53;
  }
  std::size_t below(std::size_t count) {
    return static_cast<std::size_t>(in(0.0, static_cast<double>(count)));
  }
  Vector3 point(double half) {
    const double x = in(-half, half);
    const double y = in(-half, half);
    return {x, y, in(-half, half)};
  }
  template <typename T>
  void shuffle(std::vector<T>& values) {
    for (std::size_t i = values.size(); i > 1; --i)
      std::swap(values[i - 1], values[below(i)]);
  }

private:
  std::mt19937_64 engine_;
};

/// A grid of columns x rows cells over (u, v) in [0, 1]^2, placed by \a place.
inline TriangleMesh sheet(int columns, int rows,
                          const std::function<Vector3(double, double)>& place) {
  TriangleMesh mesh;
  for (int j = 0; j <= rows; ++j)
    for (int i = 0; i <= columns; ++i)
      mesh.vertices.push_back(
          place(static_cast<double>(i) / columns, static_cast<double>(j) / rows));
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const Index a = j * (columns + 1) + i;
      const Index c = a + columns + 2;
      mesh.triangles.push_back({a, a + 1, c});
      mesh.triangles.push_back({a, c, c - 1});
    }
  return mesh;
}

/// A rectangle from \a corner along \a strike (u) and \a dip (v).
inline FaultSurface plane(const std::string& name, const Vector3& corner, const Vector3& strike,
                          const Vector3& dip, int columns = 8, int rows = 4) {
  return FaultSurface::fromMesh(name, sheet(columns, rows, [&](double u, double v) {
                                  return Vector3(corner + u * strike + v * dip);
                                }));
}

inline Points corners(const TriangleMesh& mesh, std::size_t t) {
  Points p;
  for (const Index v : mesh.triangles[t])
    p.push_back(mesh.vertices[static_cast<std::size_t>(v)]);
  return p;
}

inline Vector3 normalOf(const TriangleMesh& mesh, std::size_t t) {
  const Points p = corners(mesh, t);
  return (p[1] - p[0]).cross(p[2] - p[0]);
}

inline double areaOf(const TriangleMesh& mesh) {
  double area = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    area += 0.5 * normalOf(mesh, t).norm();
  return area;
}

} // namespace graben::test
