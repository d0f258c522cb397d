#include "graben/surface/crumbs.h"

#include "cut_state.h"

#include "graben/mesh/adjacency.h"
#include "graben/mesh/components.h"

#include <algorithm>

namespace graben {

namespace {

/// Drops components with fewer triangles than \a least, unless that leaves nothing, and empty ones.
/// \param[in]  components their triangles to be dropped anyway are not counted
/// \param[out] target     see removeUnreferencedVertices
/// \return how many were dropped, empty ones apart
std::size_t dropSmall(CutMesh& cut, const Components& components, std::size_t least, unsigned threads, std::vector<Index>& target) {
  const std::vector<std::size_t>& counts = components.triangle_count;
  if (std::none_of(counts.begin(), counts.end(), [least](std::size_t n) { return n >= least; }))
    least = 1;
  std::vector<Triangle>& triangles = cut.mesh.triangles;
  std::size_t kept = 0;
  for (std::size_t t = 0; t < triangles.size(); ++t)
    if (counts[static_cast<std::size_t>(components.of_triangle[t])] >= least && triangles[t][0] != triangles[t][1])
      triangles[kept++] = triangles[t];
  triangles.resize(kept);
  target = removeUnreferencedVertices(cut, threads);
  return static_cast<std::size_t>(std::count_if(counts.begin(), counts.end(), [least](std::size_t n) { return 0 < n && n < least; }));
}

Index startOf(const TriangleMesh& mesh, Index half_edge) {
  return mesh.triangles[static_cast<std::size_t>(half_edge / 3)][static_cast<std::size_t>(half_edge % 3)];
}

/// The corners at a vertex, those of triangles without edges left out, in groups that hang together over edges.
std::vector<std::vector<Index>> fansAt(const TriangleMesh& mesh, VertexCorners::Range corners) {
  const auto previous = [](Index c) { return c % 3 == 0 ? c + 2 : c - 1; };
  const auto next = [](Index c) { return c % 3 == 2 ? c - 2 : c + 1; };
  std::vector<std::vector<Index>> fans;
  std::vector<Index> reached;
  const auto reach = [&](Index corner) {
    if (corner < 0 || std::find(reached.begin(), reached.end(), corner) != reached.end())
      return;
    reached.push_back(corner);
    fans.back().push_back(corner);
  };
  for (const Index c : corners) {
    if (startOf(mesh, c) == startOf(mesh, next(c)) || std::find(reached.begin(), reached.end(), c) != reached.end())
      continue;
    fans.emplace_back();
    reach(c);
    for (std::size_t i = 0; i < fans.back().size(); ++i) {
      const Index corner = fans.back()[i];
      const Index twin = twinOf(mesh, corners, corner);
      reach(twin < 0 ? -1 : next(twin));
      reach(twinOf(mesh, corners, previous(corner)));
    }
  }
  return fans;
}

} // namespace

std::size_t removeCrumbs(CutMesh& cut, std::size_t least, unsigned threads) {
  const Components components = connectedComponents(cut.mesh, threads);
  if (components.triangle_count.empty() || components.triangle_count.front() < least || components.triangle_count.back() >= least)
    return 0;
  std::vector<Index> target;
  return dropSmall(cut, components, least, threads, target);
}

std::size_t TriangleRemoval::take(const std::vector<Index>& triangles) {
  if (taken_.size() + triangles.size() >= cut_.mesh.triangles.size())
    return 0;
  for (const Index t : triangles) {
    Triangle& triangle = cut_.mesh.triangles[static_cast<std::size_t>(t)];
    touched_.insert(touched_.end(), triangle.begin(), triangle.end());
    triangle = {triangle[0], triangle[0], triangle[0]};
  }
  taken_.insert(taken_.end(), triangles.begin(), triangles.end());
  return triangles.size();
}

void TriangleRemoval::divide(Index vertex) {
  const std::vector<std::vector<Index>> fans = fansAt(cut_.mesh, corners_.of(static_cast<std::size_t>(vertex)));
  for (std::size_t fan = 1; fan < fans.size(); ++fan) {
    const auto copy = static_cast<Index>(cut_.mesh.vertices.size());
    copyVertex(cut_, vertex);
    touched_.push_back(copy);
    for (const Index c : fans[fan])
      cut_.mesh.triangles[static_cast<std::size_t>(c / 3)][static_cast<std::size_t>(c % 3)] = copy;
  }
}

TriangleRemoval::Result TriangleRemoval::finish(std::size_t least, unsigned threads) {
  std::sort(touched_.begin(), touched_.end());
  touched_.erase(std::unique(touched_.begin(), touched_.end()), touched_.end());
  for (std::size_t i = 0, count = touched_.size(); i < count; ++i)
    divide(touched_[i]);
  Components components = connectedComponents(cut_.mesh, threads);
  for (const Index t : taken_)
    --components.triangle_count[static_cast<std::size_t>(components.of_triangle[static_cast<std::size_t>(t)])];
  Result result;
  std::vector<Index> target;
  result.crumbs = dropSmall(cut_, components, least, threads, target);
  for (const Index v : touched_) {
    const Index place = target.empty() ? v : target[static_cast<std::size_t>(v)];
    if (place >= 0)
      result.touched.push_back(place);
  }
  taken_.clear();
  touched_.clear();
  return result;
}

} // namespace graben
