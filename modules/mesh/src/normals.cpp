#include "graben/mesh/normals.h"

#include "graben/core/threads.h"

#include <Eigen/Geometry>

#include <cmath>
#include <cstdint>

namespace graben {

namespace {

/// Corners (3 t + e) of proper triangles grouped by vertex: those of v are corners[first[v]] to
/// corners[first[v + 1] - 1].
struct VertexCorners {
  std::vector<std::uint32_t> first;
  std::vector<std::uint32_t> corners;

  explicit VertexCorners(const TriangleMesh& mesh)
      : first(mesh.vertices.size() + 1, 0)
      , corners(3 * mesh.triangles.size()) {
    for (const Triangle& triangle : mesh.triangles)
      for (const Index v : triangle)
        ++first[static_cast<std::size_t>(v) + 1];
    for (std::size_t v = 1; v < first.size(); ++v)
      first[v] += first[v - 1];
    std::vector<std::uint32_t> cursor(first.begin(), first.end() - 1);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      for (std::size_t e = 0; e < 3; ++e)
        corners[cursor[static_cast<std::size_t>(mesh.triangles[t][e])]++] = static_cast<std::uint32_t>(3 * t + e);
  }
};

Vector3 weightedNormal(const TriangleMesh& mesh, std::size_t corner) {
  const Triangle& t = mesh.triangles[corner / 3];
  const auto at = [&](std::size_t e) -> const Vector3& {
    return mesh.vertices[static_cast<std::size_t>(t[e % 3])];
  };
  const Vector3 u = at(corner % 3 + 1) - at(corner % 3);
  const Vector3 w = at(corner % 3 + 2) - at(corner % 3);
  const Vector3 n = u.cross(w);
  const double length = n.norm();
  if (!(length > 0.0) || !std::isfinite(length))
    return Vector3::Zero();
  return std::atan2(length, u.dot(w)) / length * n;
}

} // namespace

Vector3 areaNormal(const TriangleMesh& mesh, const Triangle& triangle) {
  const Vector3& a = mesh.vertices[static_cast<std::size_t>(triangle[0])];
  const Vector3& b = mesh.vertices[static_cast<std::size_t>(triangle[1])];
  const Vector3& c = mesh.vertices[static_cast<std::size_t>(triangle[2])];
  return (b - a).cross(c - a);
}

void computeVertexNormals(TriangleMesh& mesh, unsigned threads) {
  const VertexCorners around(mesh);
  mesh.normals.assign(mesh.vertices.size(), Vector3::UnitZ());
  parallelFor(mesh.vertices.size(), 4096, threads, [&](std::size_t v) {
    Vector3 sum = Vector3::Zero();
    for (std::size_t i = around.first[v]; i < around.first[v + 1]; ++i)
      sum += weightedNormal(mesh, around.corners[i]);
    const double length = sum.norm();
    if (length > 1e-12)
      mesh.normals[v] = sum / length;
  });
}

} // namespace graben
