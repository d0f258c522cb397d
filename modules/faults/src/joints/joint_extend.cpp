#include "joints/edge_splitter.h"
#include "joints/joint.h"
#include "joints/strip.h"

#include "graben/mesh/normals.h"

#include <algorithm>

namespace graben::detail {
namespace {

constexpr int kDeepest = 7; // border edges are halved at most this often to follow the main fault
constexpr double kDeviation =
    0.25; // of the overshoot: how far the new border may lie off the main fault's course
constexpr double kSteepest =
    0.2; // sine of the angle up to which a strip goes on longer to get as far through
constexpr double kNarrowest = 0.1; // of the overshoot: a strip narrower than this adds nothing

} // namespace

double Joint::widthAt(const Meeting& meeting) const {
  const double width = meeting.along + overshoot_ / std::max(meeting.facing, kSteepest);
  return width < kNarrowest * overshoot_ ? 0.0 : width;
}

Vector3 Joint::outerOf(const BorderPoint& p) const {
  return p.inner + widthAt(p.meeting) * p.direction;
}

void Joint::refine(const BorderPoint& a, const BorderPoint& b, int depth,
                   std::vector<BorderPoint>& between) const {
  if (depth == kDeepest)
    return;
  BorderPoint middle;
  middle.inner = 0.5 * (a.inner + b.inner);
  middle.direction = (a.direction + b.direction).normalized();
  middle.meeting = meet(middle.inner, middle.direction);
  if (!middle.meeting.met || middle.meeting.side != a.meeting.side)
    return;
  const Vector3 chord = outerOf(b) - outerOf(a);
  const Vector3 off = outerOf(middle) - outerOf(a);
  const double along = chord.squaredNorm() > 0.0 ? off.dot(chord) / chord.squaredNorm() : 0.0;
  // The first two levels are always looked at, lest bends on both sides of a middle go unseen.
  if (depth > 1 && (off - along * chord).norm() < kDeviation * overshoot_)
    return;
  std::vector<BorderPoint> first;
  std::vector<BorderPoint> second;
  refine(a, middle, depth + 1, first);
  refine(middle, b, depth + 1, second);
  if (first.empty() && second.empty() && (off - along * chord).norm() < kDeviation * overshoot_)
    return;
  between.insert(between.end(), first.begin(), first.end());
  between.push_back(middle);
  between.insert(between.end(), second.begin(), second.end());
}

void Joint::extend(const std::vector<Stretch>& stretches) {
  EdgeSplitter splitter(mesh_);
  const std::vector<Triangle> before = mesh_.triangles;
  for (const Stretch& s : stretches) {
    std::vector<Index> inner;
    std::vector<Index> outer;
    Points normals;
    const auto addPoint = [&](Index vertex, const BorderPoint& p) {
      inner.push_back(vertex);
      outer.push_back(vertex);
      if (widthAt(p.meeting) > 0.0) {
        outer.back() = static_cast<Index>(mesh_.vertices.size());
        mesh_.vertices.push_back(outerOf(p));
      }
    };
    for (std::size_t e = 0; e < s.half_edges.size(); ++e) {
      const Index h = s.half_edges[e];
      const Triangle& triangle = before[static_cast<std::size_t>(h / 3)];
      const Index a = triangle[static_cast<std::size_t>(h % 3)];
      const Index b = triangle[static_cast<std::size_t>((h % 3 + 1) % 3)];
      const Vector3 normal = areaNormal(mesh_, triangle);
      if (e == 0)
        addPoint(a, s.points[0]);
      std::vector<BorderPoint> between;
      refine(s.points[e], s.points[e + 1], 0, between);
      std::vector<Index> on_edge;
      for (const BorderPoint& p : between) {
        on_edge.push_back(static_cast<Index>(mesh_.vertices.size()));
        mesh_.vertices.push_back(p.inner);
        addPoint(on_edge.back(), p);
        normals.push_back(normal);
      }
      if (!on_edge.empty())
        splitter.split(h / 3, a, b, on_edge);
      addPoint(b, s.points[e + 1]);
      normals.push_back(normal);
    }
    addStrip(mesh_, inner, outer, normals);
  }
}

} // namespace graben::detail
