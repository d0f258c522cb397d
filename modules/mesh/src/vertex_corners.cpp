#include "graben/mesh/vertex_corners.h"

#include "group_by_vertex.h"

namespace graben {

VertexCorners::VertexCorners(const TriangleMesh& mesh, unsigned threads) {
  auto grouped = detail::groupByVertex<Index>(mesh, threads, [&mesh](std::size_t t, const auto& put) {
    for (std::size_t e = 0; e < 3; ++e)
      put(mesh.triangles[t][e], static_cast<Index>(3 * t + e));
  });
  first_ = std::move(grouped.first);
  corners_ = std::move(grouped.entries);
}

} // namespace graben
