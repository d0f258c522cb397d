#include "graben/surface/folds.h"

#include "vertex_moves.h"

#include "graben/core/sort_unique.h"
#include "graben/core/threads.h"
#include "graben/mesh/adjacency.h"
#include "graben/mesh/normals.h"

#include <algorithm>
#include <utility>

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

/// The vertices next to one along the border.
std::vector<Index> alongBorder(const TriangleMesh& mesh, VertexCorners::Range corners) {
  std::vector<Index> found;
  for (const Index corner : corners) {
    const Triangle& t = mesh.triangles[static_cast<std::size_t>(corner / 3)];
    const auto e = static_cast<std::size_t>(corner % 3);
    if (twinOf(mesh, corners, corner) == EdgeAdjacency::kBorder)
      found.push_back(t[(e + 1) % 3]);
    if (twinOf(mesh, corners, e == 0 ? corner + 2 : corner - 1) == EdgeAdjacency::kBorder)
      found.push_back(t[(e + 2) % 3]);
  }
  return found;
}

/// Moves all corners of some triangles at once to where place_of(vertex, place) says, those for which it is true.
template <typename PlaceOf>
void moveCorners(CutMesh& cut, const std::vector<Index>& triangles, const PlaceOf& place_of) {
  std::vector<Index> vertices;
  for (const Index t : triangles)
    for (const Index v : cut.mesh.triangles[static_cast<std::size_t>(t)])
      vertices.push_back(v);
  sortUnique(vertices);
  std::vector<std::pair<Index, Vector3>> moves;
  Vector3 place;
  for (const Index v : vertices)
    if (place_of(v, place))
      moves.emplace_back(v, place);
  for (const auto& [v, to] : moves)
    cut.mesh.vertices[static_cast<std::size_t>(v)] = to;
}

} // namespace

std::vector<Index> standingOut(const TriangleMesh& mesh, unsigned threads) {
  constexpr std::size_t kGrain = 1 << 13;
  return joinBlocks<Index>(mesh.triangles.size(), kGrain, threads, [&](std::size_t begin, std::size_t end, std::vector<Index>& found) {
    for (std::size_t t = begin; t < end; ++t)
      if (standsOut(mesh, mesh.triangles[t]))
        found.push_back(static_cast<Index>(t));
  });
}

std::vector<Index> turnedTriangles(const TriangleMesh& mesh, const VertexCorners& corners, const std::vector<Index>& suspects) {
  std::vector<Index> turned;
  std::copy_if(suspects.begin(), suspects.end(), std::back_inserter(turned),
               [&](Index t) { return isTurned(mesh, mesh.triangles[static_cast<std::size_t>(t)]) && isAtBorder(mesh, corners, t); });
  return turned;
}

void relaxTriangles(CutMesh& cut, const VertexCorners& corners, const std::vector<Index>& triangles) {
  moveCorners(cut, triangles, [&](Index v, Vector3& place) {
    if (cut.onFault(v))
      return false;
    Vector3 sum = Vector3::Zero();
    int count = 0;
    for (const Index corner : corners.of(static_cast<std::size_t>(v))) {
      const Triangle& t = cut.mesh.triangles[static_cast<std::size_t>(corner / 3)];
      const auto c = static_cast<std::size_t>(corner % 3);
      sum += cut.mesh.vertices[static_cast<std::size_t>(t[(c + 1) % 3])] + cut.mesh.vertices[static_cast<std::size_t>(t[(c + 2) % 3])];
      count += 2;
    }
    place = sum / count;
    return true;
  });
}

void relaxAlongFaults(CutMesh& cut, const VertexCorners& corners, const std::vector<Index>& triangles, const FaultNetwork& faults) {
  moveCorners(cut, triangles, [&](Index v, Vector3& place) {
    const auto& on = cut.vertex_faults[static_cast<std::size_t>(v)];
    if (on[0] < 0 || on[1] >= 0)
      return false;
    const std::vector<Index> beside = alongBorder(cut.mesh, corners.of(static_cast<std::size_t>(v)));
    if (beside.size() != 2 || !cut.onFault(beside[0], on[0]) || !cut.onFault(beside[1], on[0]))
      return false;
    const auto placeOf = [&](Index w) { return cut.mesh.vertices[static_cast<std::size_t>(w)]; };
    place = ontoFaults(faults, on, 0.5 * (placeOf(beside[0]) + placeOf(beside[1])));
    return true;
  });
}

} // namespace graben
