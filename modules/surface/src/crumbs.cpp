#include "graben/surface/crumbs.h"

#include "cut_state.h"

#include "graben/mesh/components.h"
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
