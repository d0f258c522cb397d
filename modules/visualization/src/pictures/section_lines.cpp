#include "graben/visualization/section.h"

#include "graben/core/errors.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace graben {
namespace {

/// A vertex relative to the section: s along it, d across it (positive to the left), and z.
struct SectionPoint {
  double s, d, z;
};

Eigen::Vector2d crossing(const SectionPoint& p, const SectionPoint& q) {
  const double t = p.d / (p.d - q.d);
  return {p.s + t * (q.s - p.s), p.z + t * (q.z - p.z)};
}

/// The part of the triangle in the plane; a vertex on the plane counts as lying to the right.
std::optional<SectionSegment> cutTriangle(const std::array<SectionPoint, 3>& corners) {
  SectionSegment segment;
  std::size_t found = 0;
  for (std::size_t e = 0; e < 3; ++e) {
    const SectionPoint& p = corners[e];
    const SectionPoint& q = corners[(e + 1) % 3];
    if ((p.d > 0.0) == (q.d > 0.0))
      continue;
    segment.ends[found++] = p.d > 0.0 ? crossing(p, q) : crossing(q, p);
  }
  return found == 2 ? std::optional<SectionSegment>(segment) : std::nullopt;
}

/// Cuts the segment off at s = 0 and s = length; false if nothing is left.
bool limit(SectionSegment& segment, double length) {
  auto& [first, last] = segment.ends;
  if (first.x() > last.x())
    std::swap(first, last);
  if (last.x() < 0.0 || first.x() > length)
    return false;
  const Eigen::Vector2d start = first;
  const Eigen::Vector2d step = last - first;
  if (first.x() < 0.0)
    first = start + step * (-start.x() / step.x());
  if (last.x() > length)
    last = start + step * ((length - start.x()) / step.x());
  return true;
}

} // namespace

std::vector<SectionSegment> cutMesh(const TriangleMesh& mesh, const SectionLine& line) {
  const Eigen::Vector2d along = (line.b - line.a).head<2>();
  const double length = along.norm();
  if (!(length > 0.0) || !std::isfinite(length))
    throw InvalidInputError("cutting a section", "its two points must be finite and differ in x or y");
  const Eigen::Vector2d unit = along / length;
  const Eigen::Vector2d left(-unit.y(), unit.x());
  const Eigen::Vector2d start = line.a.head<2>();

  std::vector<SectionSegment> segments;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    std::array<SectionPoint, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3& p = mesh.vertices[static_cast<std::size_t>(mesh.triangles[i][k])];
      const Eigen::Vector2d from_start = p.head<2>() - start;
      corners[k] = {unit.dot(from_start), left.dot(from_start), p.z()};
    }
    std::optional<SectionSegment> segment = cutTriangle(corners);
    if (!segment || !limit(*segment, length))
      continue;
    segment->triangle = static_cast<Index>(i);
    segments.push_back(*segment);
  }
  return segments;
}

} // namespace graben
