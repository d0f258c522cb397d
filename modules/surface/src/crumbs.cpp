#include "graben/surface/crumbs.h"

#include "cut_state.h"

#include "graben/mesh/adjacency.h"
#include "graben/mesh/components.h"
#include "graben/mesh/normals.h"
#include "graben/surface/fault_cut.h"

#include <algorithm>

namespace graben {

std::size_t removeCrumbs(CutMesh& cut, std::size_t least) {
  const Components components = connectedComponents(cut.mesh);
  if (components.triangle_count.empty() || components.triangle_count.front() < least)
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

std::vector<Index> turnedTriangles(const CutMesh& cut, bool at_border) {
  constexpr double limit = 0.26; // cosine of 75 degrees
  const TriangleMesh& mesh = cut.mesh;
  std::vector<Index> turned;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    Vector3 mean = Vector3::Zero();
    for (const Index v : mesh.triangles[t])
      mean += mesh.normals[static_cast<std::size_t>(v)];
    const Vector3 n = areaNormal(mesh, mesh.triangles[t]);
    if (n.dot(mean) < limit * n.norm() * mean.norm())
      turned.push_back(static_cast<Index>(t));
  }
  if (!at_border || turned.empty())
    return turned;
  const EdgeAdjacency adjacency(mesh);
  turned.erase(std::remove_if(turned.begin(), turned.end(),
                              [&](Index t) {
                                return !adjacency.isBorder(3 * t) && !adjacency.isBorder(3 * t + 1) && !adjacency.isBorder(3 * t + 2);
                              }),
               turned.end());
  return turned;
}

void removeTriangles(CutMesh& cut, const std::vector<Index>& triangles) {
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
  openCuts(state);
  cut = std::move(state.out);
  removeUnreferencedVertices(cut);
}

} // namespace graben
