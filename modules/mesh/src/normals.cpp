#include "graben/mesh/normals.h"

#include "graben/core/threads.h"

#include <Eigen/Geometry>

#include <cmath>

namespace graben {

namespace {

Vector3 weightedNormal(const TriangleMesh& mesh, Index half_edge) {
  const auto corner = static_cast<std::size_t>(half_edge);
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

Vector3 normalAt(const TriangleMesh& mesh, const VertexCorners& corners, std::size_t vertex) {
  Vector3 sum = Vector3::Zero();
  for (const Index corner : corners.of(vertex))
    sum += weightedNormal(mesh, corner);
  const double length = sum.norm();
  return length > 1e-12 ? Vector3(sum / length) : Vector3(Vector3::UnitZ());
}

} // namespace

Vector3 areaNormal(const TriangleMesh& mesh, const Triangle& triangle) {
  const Vector3& a = mesh.vertices[static_cast<std::size_t>(triangle[0])];
  const Vector3& b = mesh.vertices[static_cast<std::size_t>(triangle[1])];
  const Vector3& c = mesh.vertices[static_cast<std::size_t>(triangle[2])];
  return (b - a).cross(c - a);
}

void computeVertexNormals(TriangleMesh& mesh, unsigned threads) {
  computeVertexNormals(mesh, VertexCorners(mesh, threads), threads);
}

void computeVertexNormals(TriangleMesh& mesh, const VertexCorners& corners, unsigned threads) {
  mesh.normals.resize(mesh.vertices.size());
  parallelFor(mesh.vertices.size(), 4096, threads, [&](std::size_t v) { mesh.normals[v] = normalAt(mesh, corners, v); });
}

void updateVertexNormals(TriangleMesh& mesh, const VertexCorners& corners, const std::vector<Index>& vertices, unsigned threads) {
  parallelFor(vertices.size(), 1024, threads, [&](std::size_t i) {
    const auto v = static_cast<std::size_t>(vertices[i]);
    mesh.normals[v] = normalAt(mesh, corners, v);
  });
}

} // namespace graben
