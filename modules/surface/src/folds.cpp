#include "graben/surface/folds.h"

#include "graben/core/threads.h"
#include "graben/mesh/adjacency.h"
#include "graben/mesh/normals.h"

#include <algorithm>

namespace graben {

namespace {

bool standsOut(const TriangleMesh& mesh, const Triangle& triangle) {
  constexpr double limit = 0.71; // cosine of 45 degrees
  const Vector3 n = areaNormal(mesh, triangle);
  const double least = limit * limit * n.squaredNorm();
  return !std::all_of(triangle.begin(), triangle.end(), [&](Index v) {
    const double along = n.dot(mesh.normals[static_cast<std::size_t>(v)]);
    return along >= 0.0 && along * along >= least;
  });
}

bool isTurned(const TriangleMesh& mesh, const Triangle& triangle) {
  constexpr double limit = 0.26; // cosine of 75 degrees
  Vector3 mean = Vector3::Zero();
  for (const Index v : triangle)
    mean += mesh.normals[static_cast<std::size_t>(v)];
  const Vector3 n = areaNormal(mesh, triangle);
  return n.dot(mean) < limit * n.norm() * mean.norm();
}

bool isAtBorder(const TriangleMesh& mesh, const VertexCorners& corners, Index t) {
  const Triangle& triangle = mesh.triangles[static_cast<std::size_t>(t)];
  for (std::size_t e = 0; e < 3; ++e)
    if (twinOf(mesh, corners.of(static_cast<std::size_t>(triangle[e])), 3 * t + static_cast<Index>(e)) == EdgeAdjacency::kBorder)
      return true;
  return false;
}

} // namespace

std::vector<Index> standingOut(const TriangleMesh& mesh, unsigned threads) {
  constexpr std::size_t kGrain = 1 << 13;
  std::vector<std::vector<Index>> blocks((mesh.triangles.size() + kGrain - 1) / kGrain);
  parallelFor(mesh.triangles.size(), kGrain, threads, [&](std::size_t t) {
    if (standsOut(mesh, mesh.triangles[t]))
      blocks[t / kGrain].push_back(static_cast<Index>(t));
  });
  std::vector<Index> found;
  for (const std::vector<Index>& block : blocks)
    found.insert(found.end(), block.begin(), block.end());
  return found;
}

std::vector<Index> turnedTriangles(const TriangleMesh& mesh, const VertexCorners& corners, const std::vector<Index>& suspects) {
  std::vector<Index> turned;
  std::copy_if(suspects.begin(), suspects.end(), std::back_inserter(turned),
               [&](Index t) { return isTurned(mesh, mesh.triangles[static_cast<std::size_t>(t)]) && isAtBorder(mesh, corners, t); });
  return turned;
}

void relaxTriangles(CutMesh& cut, const VertexCorners& corners, const std::vector<Index>& triangles) {
  std::vector<Index> vertices;
  for (const Index t : triangles)
    for (const Index v : cut.mesh.triangles[static_cast<std::size_t>(t)])
      if (!cut.onFault(v))
        vertices.push_back(v);
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());

  Points places;
  for (const Index v : vertices) {
    Vector3 sum = Vector3::Zero();
    int count = 0;
    for (const Index corner : corners.of(static_cast<std::size_t>(v))) {
      const Triangle& t = cut.mesh.triangles[static_cast<std::size_t>(corner / 3)];
      const auto c = static_cast<std::size_t>(corner % 3);
      sum += cut.mesh.vertices[static_cast<std::size_t>(t[(c + 1) % 3])] + cut.mesh.vertices[static_cast<std::size_t>(t[(c + 2) % 3])];
      count += 2;
    }
    places.emplace_back(sum / count);
  }
  for (std::size_t i = 0; i < vertices.size(); ++i)
    cut.mesh.vertices[static_cast<std::size_t>(vertices[i])] = places[i];
}

} // namespace graben
