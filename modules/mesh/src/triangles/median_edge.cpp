#include "graben/mesh/median_edge.h"

#include <algorithm>

namespace graben {

double medianEdge(const TriangleMesh& mesh) {
  std::vector<double> lengths;
  lengths.reserve(3 * mesh.triangles.size());
  for (const Triangle& t : mesh.triangles)
    for (std::size_t e = 0; e < 3; ++e)
      lengths.push_back((mesh.vertices[static_cast<std::size_t>(t[e])] -
                         mesh.vertices[static_cast<std::size_t>(t[(e + 1) % 3])])
                            .norm());
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  return *middle;
}

} // namespace graben
