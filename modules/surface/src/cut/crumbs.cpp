#include "graben/surface/crumbs.h"

#include "fans.h"

#include "graben/core/sort_unique.h"
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
  std::vector<Index> left;
  for (const Index c : corners_.of(static_cast<std::size_t>(vertex)))
    if (const Triangle& t = cut_.mesh.triangles[static_cast<std::size_t>(c / 3)]; t[0] != t[1])
      left.push_back(c);
  Fans fans(cut_);
  const std::size_t count = fans.find(vertex, {left.data(), left.data() + left.size()});
  if (count < 2)
    return;
  const auto copies = static_cast<Index>(cut_.mesh.vertices.size());
  for (std::size_t fan = 1; fan < count; ++fan) {
    touched_.push_back(static_cast<Index>(cut_.mesh.vertices.size()));
    copyVertex(cut_, vertex);
  }
  fans.visit([&](Index c, std::size_t fan) {
    if (fan > 0)
      cut_.mesh.triangles[static_cast<std::size_t>(c / 3)][static_cast<std::size_t>(c % 3)] = copies + static_cast<Index>(fan) - 1;
  });
}

TriangleRemoval::Result TriangleRemoval::finish(std::size_t least, unsigned threads) {
  sortUnique(touched_);
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
