#include "outer_edge.h"

#include "graben/core/threads.h"
#include "graben/mesh/adjacency.h"
#include "graben/mesh/normals.h"

#include <algorithm>
#include <array>

namespace graben {

OuterEdge::OuterEdge(const TriangleMesh& truth, const FaultNetwork& network, double tolerance, unsigned threads)
    : truth_(truth)
    , half_edge_(3 * truth.triangles.size(), Border::No)
    , vertex_(truth.vertices.size(), Border::No) {
  const EdgeAdjacency adjacency(truth, threads);
  const auto ends = [&truth](std::size_t h) { return std::array{truth.triangles[h / 3][h % 3], truth.triangles[h / 3][(h + 1) % 3]}; };
  const auto vertex = [&truth](Index v) -> const Vector3& { return truth.vertices[static_cast<std::size_t>(v)]; };
  parallelFor(half_edge_.size(), 4096, threads, [&](std::size_t h) {
    if (!adjacency.isBorder(static_cast<Index>(h)))
      return;
    const Vector3 middle = 0.5 * (vertex(ends(h)[0]) + vertex(ends(h)[1]));
    half_edge_[h] = !network.empty() && network.nearest(middle, tolerance).fault >= 0 ? Border::Fault : Border::Outer;
  });
  TriangleMesh edge;
  edge.vertices = truth.vertices;
  std::vector<char> at_fault(truth.vertices.size(), 0);
  for (std::size_t h = 0; h < half_edge_.size(); ++h)
    for (const Index v : ends(h)) {
      if (half_edge_[h] == Border::No)
        continue;
      Border& border = vertex_[static_cast<std::size_t>(v)];
      border = half_edge_[h] == Border::Outer || border == Border::Outer ? Border::Outer : Border::Fault;
      if (half_edge_[h] == Border::Fault)
        at_fault[static_cast<std::size_t>(v)] = 1;
    }
  for (std::size_t h = 0; h < half_edge_.size(); ++h)
    if (half_edge_[h] == Border::Outer)
      edge.triangles.push_back({ends(h)[0], ends(h)[1], ends(h)[1]});
  for (std::size_t v = 0; v < vertex_.size(); ++v)
    if (vertex_[v] == Border::Outer && at_fault[v] != 0)
      ends_.push_back(truth.vertices[v]);
  removeUnreferencedVertices(edge);
  edge_ = TriangleBvh(edge, threads);
}

OuterEdge::Border OuterEdge::borderAt(const MeshPoint& nearest) const {
  const auto t = static_cast<std::size_t>(nearest.triangle);
  int zeros = 0;
  std::size_t zero = 0, one = 0; // corners
  for (std::size_t k = 0; k < 3; ++k)
    if (nearest.barycentric[static_cast<int>(k)] == 0.0) {
      ++zeros;
      zero = k;
    } else
      one = k;
  if (zeros == 1)
    return half_edge_[3 * t + (zero + 1) % 3];
  return zeros == 2 ? vertex_[static_cast<std::size_t>(truth_.triangles[t][one])] : Border::No;
}

bool OuterEdge::isBeyond(const Vector3& p, const MeshPoint& nearest) const {
  const Border border = nearest.triangle < 0 ? Border::No : borderAt(nearest);
  if (border == Border::No)
    return false;
  if (border == Border::Fault)
    return std::any_of(ends_.begin(), ends_.end(), [&](const Vector3& end) { return (end - nearest.point).norm() <= nearest.distance; });
  const Vector3 normal = areaNormal(truth_, truth_.triangles[static_cast<std::size_t>(nearest.triangle)]).normalized();
  const Vector3 away = p - nearest.point;
  return (away - away.dot(normal) * normal).norm() > 1e-9 * (1.0 + p.norm());
}

} // namespace graben
