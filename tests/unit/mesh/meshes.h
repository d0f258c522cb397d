#pragma once

#include "graben/mesh/triangle_mesh.h"

#include <random>

namespace graben::test {

/// A number in [low, high), the same with every standard library.
inline double uniform(std::mt19937_64& generator, double low, double high) {
  return low + (high - low) * (static_cast<double>(generator() >> 11) * 0x1.0p-53);
}

inline Vector3 randomPoint(std::mt19937_64& generator, double low, double high) {
  const double x = uniform(generator, low, high);
  const double y = uniform(generator, low, high);
  return {x, y, uniform(generator, low, high)};
}

/// n x n square cells of edge \a cell in the plane z = 0 from (offset, offset), two triangles each,
/// normals up.
inline TriangleMesh gridMesh(Index n, double cell = 1.0, double offset = 0.0) {
  TriangleMesh mesh;
  for (Index j = 0; j <= n; ++j)
    for (Index i = 0; i <= n; ++i)
      mesh.vertices.emplace_back(offset + i * cell, offset + j * cell, 0.0);
  for (Index j = 0; j < n; ++j)
    for (Index i = 0; i < n; ++i) {
      const Index v = j * (n + 1) + i;
      mesh.triangles.push_back({v, v + 1, v + n + 2});
      mesh.triangles.push_back({v, v + n + 2, v + n + 1});
    }
  return mesh;
}

/// Triangles of about \a size strewn over a cube, each with its own vertices.
inline TriangleMesh soup(std::mt19937_64& generator, Index count, double cube, double size) {
  TriangleMesh mesh;
  for (Index t = 0; t < count; ++t) {
    const Vector3 centre = randomPoint(generator, -cube, cube);
    for (Index e = 0; e < 3; ++e)
      mesh.vertices.push_back(centre + randomPoint(generator, -size, size));
    mesh.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  return mesh;
}

} // namespace graben::test
