#include "graben/surface/crumbs.h"

#include "cut_state.h"

#include "graben/core/threads.h"
#include "graben/mesh/components.h"
#include "graben/mesh/normals.h"
#include "graben/surface/fault_cut.h"

#include <algorithm>

namespace graben {

std::size_t removeCrumbs(CutMesh& cut, std::size_t least) {
  const Components components = connectedComponents(cut.mesh);
  if (components.triangle_count.empty() || components.triangle_count.front() < least || components.triangle_count.back() >= least)
    return 0;
  std::vector<Triangle>& triangles = cut.mesh.triangles;
  std::size_t kept = 0;
  for (std::size_t t = 0; t < triangles.size(); ++t)
    if (components.triangle_count[static_cast<std::size_t>(components.of_triangle[t])] >= least)
      triangles[kept++] = triangles[t];
  triangles.resize(kept);
  removeUnreferencedVertices(cut);
  return static_cast<std::size_t>(std::count_if(components.triangle_count.begin(), components.triangle_count.end(),
                                                [least](std::size_t n) { return n < least; }));
}

namespace {

/// Of some triangles those with an edge that no other triangle of the mesh has; looks only at triangles with corners in common.
std::vector<Index> onBorder(const TriangleMesh& mesh, const std::vector<Index>& triangles) {
  using Edge = std::array<Index, 2>;
  const auto edgeOf = [](const Triangle& t, std::size_t e) { return Edge{std::min(t[e], t[(e + 1) % 3]), std::max(t[e], t[(e + 1) % 3])}; };
  std::vector<std::uint8_t> corner(mesh.vertices.size(), 0);
  for (const Index t : triangles)
    for (const Index v : mesh.triangles[static_cast<std::size_t>(t)])
      corner[static_cast<std::size_t>(v)] = 1;
  std::vector<Edge> edges;
  for (const Triangle& t : mesh.triangles)
    for (std::size_t e = 0; e < 3; ++e)
      if (corner[static_cast<std::size_t>(t[e])] + corner[static_cast<std::size_t>(t[(e + 1) % 3])] == 2)
        edges.push_back(edgeOf(t, e));
  std::sort(edges.begin(), edges.end());
  std::vector<Index> found;
  for (const Index t : triangles)
    for (std::size_t e = 0; e < 3; ++e) {
      const auto [first, last] = std::equal_range(edges.begin(), edges.end(), edgeOf(mesh.triangles[static_cast<std::size_t>(t)], e));
      if (last - first == 1) {
        found.push_back(t);
        break;
      }
    }
  return found;
}

} // namespace

std::vector<Index> turnedTriangles(const CutMesh& cut, bool at_border, unsigned threads) {
  constexpr double limit = 0.26; // cosine of 75 degrees
  const TriangleMesh& mesh = cut.mesh;
  std::vector<std::uint8_t> is_turned(mesh.triangles.size(), 0);
  parallelFor(is_turned.size(), 4096, threads, [&](std::size_t t) {
    Vector3 mean = Vector3::Zero();
    for (const Index v : mesh.triangles[t])
      mean += mesh.normals[static_cast<std::size_t>(v)];
    const Vector3 n = areaNormal(mesh, mesh.triangles[t]);
    is_turned[t] = n.dot(mean) < limit * n.norm() * mean.norm() ? 1 : 0;
  });
  std::vector<Index> turned;
  for (std::size_t t = 0; t < is_turned.size(); ++t)
    if (is_turned[t] != 0)
      turned.push_back(static_cast<Index>(t));
  return at_border && !turned.empty() ? onBorder(mesh, turned) : turned;
}

void removeTriangles(CutMesh& cut, const std::vector<Index>& triangles, unsigned threads) {
  std::vector<Triangle>& all = cut.mesh.triangles;
  std::size_t kept = 0;
  auto next = triangles.begin();
  for (std::size_t t = 0; t < all.size(); ++t) {
    if (next != triangles.end() && *next == static_cast<Index>(t))
      ++next;
    else
      all[kept++] = all[t];
  }
  all.resize(kept);
  CutState state;
  state.out = std::move(cut);
  openCuts(state, threads);
  cut = std::move(state.out);
  removeUnreferencedVertices(cut, threads);
}

} // namespace graben
