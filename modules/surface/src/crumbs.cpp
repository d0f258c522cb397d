#include "graben/surface/crumbs.h"

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

} // namespace graben
