#include "graben/surface/viewpoints.h"

#include <algorithm>

namespace graben {

namespace {

constexpr double kInside = 0.5; // of the way to the mean of the triangles' centroids

} // namespace

Viewpoints::Viewpoints(const CutMesh& cut, const VertexCorners& corners) : cut_(cut) {
  const TriangleMesh& mesh = cut.mesh;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    if (!cut.onFault(static_cast<Index>(v)))
      continue;
    Vector3 sum = Vector3::Zero();
    double count = 0.0;
    for (const Index corner : corners.of(v)) {
      for (const Index w : mesh.triangles[static_cast<std::size_t>(corner) / 3])
        sum += mesh.vertices[static_cast<std::size_t>(w)];
      count += 3.0;
    }
    on_faults_.push_back(static_cast<Index>(v));
    beside_.push_back(count > 0.0 ? Vector3(mesh.vertices[v] + kInside * (sum / count - mesh.vertices[v])) : mesh.vertices[v]);
  }
}

const Vector3& Viewpoints::of(Index vertex) const {
  if (!cut_.onFault(vertex))
    return cut_.mesh.vertices[static_cast<std::size_t>(vertex)];
  return beside_[static_cast<std::size_t>(std::lower_bound(on_faults_.begin(), on_faults_.end(), vertex) - on_faults_.begin())];
}

} // namespace graben
