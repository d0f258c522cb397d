#pragma once

#include "graben/model/block_model.h"

#include <functional>

namespace graben::test {

/// A surface over the square from -size to size as a grid, z = height(x, y).
inline TriangleMesh surfaceOver(double size, Index cells, const std::function<double(double, double)>& height) {
  TriangleMesh mesh;
  for (Index j = 0; j <= cells; ++j)
    for (Index i = 0; i <= cells; ++i) {
      const double x = size * (2.0 * i / cells - 1.0), y = size * (2.0 * j / cells - 1.0);
      mesh.vertices.emplace_back(x, y, height(x, y));
    }
  for (Index j = 0; j < cells; ++j)
    for (Index i = 0; i < cells; ++i) {
      const Index v = j * (cells + 1) + i;
      mesh.triangles.push_back({v, v + 1, v + cells + 2});
      mesh.triangles.push_back({v, v + cells + 2, v + cells + 1});
    }
  return mesh;
}

/// A plane fault through \a at with the given strike direction in x, y and dip towards its right, \a along to both sides of it and 300 up and down.
inline FaultSurface planeFault(const std::string& name, const Vector3& at, const Eigen::Vector2d& strike, double dip_tangent, double before, double after) {
  TriangleMesh mesh;
  const Eigen::Vector2d right(strike.y(), -strike.x());
  constexpr Index kSteps = 12;
  for (Index j = 0; j <= kSteps; ++j)
    for (Index i = 0; i <= kSteps; ++i) {
      const double s = before + (after - before) * i / kSteps, z = 300.0 - 600.0 * j / kSteps;
      const Eigen::Vector2d p = at.head<2>() + s * strike - z / dip_tangent * right;
      mesh.vertices.emplace_back(p.x(), p.y(), at.z() + z);
    }
  for (Index j = 0; j < kSteps; ++j)
    for (Index i = 0; i < kSteps; ++i) {
      const Index v = j * (kSteps + 1) + i;
      mesh.triangles.push_back({v, v + 1, v + kSteps + 2});
      mesh.triangles.push_back({v, v + kSteps + 2, v + kSteps + 1});
    }
  return FaultSurface::fromMesh(name, mesh);
}

/// A box of 400 x 400 x 300 about the origin.
inline BlockModelOptions smallBox(double size = 20.0) {
  BlockModelOptions o;
  o.box.extend(Vector3(-200, -200, -150));
  o.box.extend(Vector3(200, 200, 150));
  o.size = size;
  return o;
}

} // namespace graben::test
