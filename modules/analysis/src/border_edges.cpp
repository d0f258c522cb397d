#include "border_edges.h"

namespace graben {

std::vector<std::array<Index, 2>> borderEdges(const TriangleMesh& mesh, unsigned threads) {
  return borderEdges(mesh, EdgeAdjacency(mesh, threads));
}

std::vector<std::array<Index, 2>> borderEdges(const TriangleMesh& mesh, const EdgeAdjacency& adjacency) {
  std::vector<std::array<Index, 2>> edges;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t e = 0; e < 3; ++e)
      if (adjacency.isBorder(static_cast<Index>(3 * t + e)))
        edges.push_back({mesh.triangles[t][e], mesh.triangles[t][(e + 1) % 3]});
  return edges;
}

TriangleMesh borderMesh(const TriangleMesh& mesh, unsigned threads) {
  TriangleMesh border;
  border.vertices = mesh.vertices;
  for (const auto& [from, to] : borderEdges(mesh, threads))
    border.triangles.push_back({from, to, to});
  removeUnreferencedVertices(border);
  return border;
}

} // namespace graben
