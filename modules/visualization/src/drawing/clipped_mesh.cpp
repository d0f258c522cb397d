#include "drawing/clipped_mesh.h"

namespace graben {

namespace {

/// Cuts a polygon off where inside() is negative.
template <typename Inside>
Points cutOff(const Points& polygon, Inside inside) {
  Points kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector3& p = polygon[i];
    const Vector3& q = polygon[(i + 1) % polygon.size()];
    const double a = inside(p), b = inside(q);
    if (a >= 0.0)
      kept.push_back(p);
    if ((a >= 0.0) != (b >= 0.0))
      kept.push_back(p + a / (a - b) * (q - p));
  }
  return kept;
}

} // namespace

TriangleMesh clippedMesh(const TriangleMesh& mesh, const Bounds& box) {
  TriangleMesh clipped;
  for (const Triangle& t : mesh.triangles) {
    Points polygon;
    for (const Index v : t)
      polygon.push_back(mesh.vertices[static_cast<std::size_t>(v)]);
    for (int axis = 0; axis < 3; ++axis) {
      polygon = cutOff(polygon, [&](const Vector3& p) { return p[axis] - box.low[axis]; });
      polygon = cutOff(polygon, [&](const Vector3& p) { return box.high[axis] - p[axis]; });
    }
    const auto first = static_cast<Index>(clipped.vertices.size());
    for (std::size_t i = 2; i < polygon.size(); ++i)
      clipped.triangles.push_back({first, first + static_cast<Index>(i) - 1, first + static_cast<Index>(i)});
    clipped.vertices.insert(clipped.vertices.end(), polygon.begin(), polygon.end());
  }
  removeUnreferencedVertices(clipped);
  return clipped;
}

Bounds boxAroundSurface(const TriangleMesh& surface) {
  Bounds box;
  for (const Triangle& t : surface.triangles)
    for (const Index v : t)
      box.extend(surface.vertices[static_cast<std::size_t>(v)]);
  if (box.empty())
    return box;
  const Vector3 size = box.size();
  Vector3 margin(0.02 * size.x(), 0.02 * size.y(), 0.15 * size.z());
  margin = margin.cwiseMax(1e-3 * box.diagonal());
  return {box.low - margin, box.high + margin};
}

} // namespace graben
