#include "outer_edge.h"

#include "graben/core/threads.h"
#include "graben/mesh/adjacency.h"
#include "graben/mesh/normals.h"

namespace graben {

OuterEdge::OuterEdge(const TriangleMesh& truth, const FaultNetwork& network, double tolerance, unsigned threads)
    : truth_(truth)
    , half_edge_(3 * truth.triangles.size())
    , vertex_(truth.vertices.size())
    , at_fault_(truth.vertices.size()) {
  const EdgeAdjacency adjacency(truth, threads);
  constexpr char kOuter = 1, kFault = 2;
  const auto ends = [&truth](std::size_t h) {
    const Triangle& triangle = truth.triangles[h / 3];
    return std::pair(static_cast<std::size_t>(triangle[h % 3]), static_cast<std::size_t>(triangle[(h + 1) % 3]));
  };
  parallelFor(half_edge_.size(), 4096, threads, [&](std::size_t h) {
    if (!adjacency.isBorder(static_cast<Index>(h)))
      return;
    const auto [from, to] = ends(h);
    const Vector3 middle = 0.5 * (truth.vertices[from] + truth.vertices[to]);
    half_edge_[h] = !network.empty() && network.nearest(middle, tolerance).fault >= 0 ? kFault : kOuter;
  });
  for (std::size_t h = 0; h < half_edge_.size(); ++h) {
    if (half_edge_[h] == 0)
      continue;
    const auto [from, to] = ends(h);
    std::vector<char>& of = half_edge_[h] == kOuter ? vertex_ : at_fault_;
    of[from] = of[to] = 1;
    half_edge_[h] = half_edge_[h] == kOuter ? 1 : 0;
  }
}

bool OuterEdge::isOnEdge(const MeshPoint& nearest) const {
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
    return half_edge_[3 * t + (zero + 1) % 3] != 0;
  return zeros == 2 && vertex_[static_cast<std::size_t>(truth_.triangles[t][one])] != 0;
}

bool OuterEdge::isBeyond(const Vector3& p, const MeshPoint& nearest) const {
  if (nearest.triangle < 0 || !isOnEdge(nearest))
    return false;
  const Vector3 normal = areaNormal(truth_, truth_.triangles[static_cast<std::size_t>(nearest.triangle)]).normalized();
  const Vector3 away = p - nearest.point;
  return (away - away.dot(normal) * normal).norm() > 1e-9 * (1.0 + p.norm());
}

Points OuterEdge::ends() const {
  Points points;
  for (std::size_t v = 0; v < vertex_.size(); ++v)
    if (vertex_[v] != 0 && at_fault_[v] != 0)
      points.push_back(truth_.vertices[v]);
  return points;
}

} // namespace graben
