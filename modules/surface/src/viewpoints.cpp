#include "graben/surface/viewpoints.h"

#include <algorithm>

namespace graben {

namespace {

constexpr double kInside = 0.5; // of the way to the mean of the triangles' centroids

} // namespace

Viewpoints::Viewpoints(const CutMesh& cut) : cut_(cut) {
  for (std::size_t v = 0; v < cut.vertex_faults.size(); ++v)
    if (cut.onFault(static_cast<Index>(v)))
      on_faults_.push_back(static_cast<Index>(v));
  if (on_faults_.empty())
    return;
  Points sums(on_faults_.size(), Vector3::Zero());
  std::vector<int> counts(on_faults_.size(), 0);
  for (const Triangle& t : cut.mesh.triangles)
    for (const Index v : t) {
      if (!cut.onFault(v))
        continue;
      const auto i = static_cast<std::size_t>(std::lower_bound(on_faults_.begin(), on_faults_.end(), v) - on_faults_.begin());
      for (const Index corner : t)
        sums[i] += cut.mesh.vertices[static_cast<std::size_t>(corner)] / 3.0;
      ++counts[i];
    }
  beside_.reserve(on_faults_.size());
  for (std::size_t i = 0; i < on_faults_.size(); ++i) {
    const Vector3& at = cut.mesh.vertices[static_cast<std::size_t>(on_faults_[i])];
    beside_.push_back(counts[i] > 0 ? Vector3(at + kInside * (sums[i] / counts[i] - at)) : at);
  }
}

const Vector3& Viewpoints::of(Index vertex) const {
  if (!cut_.onFault(vertex))
    return cut_.mesh.vertices[static_cast<std::size_t>(vertex)];
  return beside_[static_cast<std::size_t>(std::lower_bound(on_faults_.begin(), on_faults_.end(), vertex) - on_faults_.begin())];
}

} // namespace graben
