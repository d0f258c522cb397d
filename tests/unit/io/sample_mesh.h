#pragma once

#include "graben/mesh/triangle_mesh.h"

namespace graben::test {

/// Two pieces of two triangles at UTM coordinates that no float32 holds, with all vertex fields.
inline TriangleMesh sampleMesh() {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.vertices.push_back({460288.234863 + 50.0 * (i % 2), 5933079.866211 + 50.0 / 3.0 * (i / 2),
                             1658.767822 + 0.1 * i + (i >= 4 ? 20.0 : 0.0)});
    mesh.normals.push_back(Vector3(0.01 * i, -0.02, 1.0).normalized());
    mesh.piece.push_back(i / 4);
    mesh.scalars["throw"].push_back(0.25F * static_cast<float>(i));
    mesh.scalars["error"].push_back(1.0F / static_cast<float>(i + 1));
  }
  mesh.triangles = {{0, 1, 2}, {1, 3, 2}, {4, 5, 6}, {5, 7, 6}};
  return mesh;
}

} // namespace graben::test
