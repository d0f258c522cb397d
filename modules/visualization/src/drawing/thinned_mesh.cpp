#include "drawing/thinned_mesh.h"

#include "graben/mesh/bounds.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <tuple>

namespace graben {

namespace {

constexpr double kGrowth = 1.25; // of the cells, from one try to the next

/// For each vertex the one that stands for it.
std::vector<Index> standIns(const TriangleMesh& mesh, double cell) {
  using Key = std::tuple<std::int64_t, std::int64_t, std::int64_t, Index>;
  const auto keyOf = [&](Index v) {
    const Vector3& p = mesh.vertices[static_cast<std::size_t>(v)];
    const auto at = [cell](double x) { return static_cast<std::int64_t>(std::floor(x / cell)); };
    return Key(at(p.x()), at(p.y()), at(p.z()), mesh.piece.empty() ? 0 : mesh.piece[static_cast<std::size_t>(v)]);
  };
  std::vector<std::pair<Key, Index>> order;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    order.emplace_back(keyOf(static_cast<Index>(v)), static_cast<Index>(v));
  std::sort(order.begin(), order.end());
  std::vector<Index> stand_in(mesh.vertices.size());
  Index first = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i == 0 || order[i].first != order[i - 1].first)
      first = order[i].second;
    stand_in[static_cast<std::size_t>(order[i].second)] = first;
  }
  return stand_in;
}

std::vector<Triangle> trianglesOf(const TriangleMesh& mesh, const std::vector<Index>& stand_in) {
  std::vector<Triangle> triangles;
  for (const Triangle& t : mesh.triangles) {
    Triangle s;
    std::transform(t.begin(), t.end(), s.begin(), [&](Index v) { return stand_in[static_cast<std::size_t>(v)]; });
    if (s[0] == s[1] || s[1] == s[2] || s[2] == s[0])
      continue;
    std::rotate(s.begin(), std::min_element(s.begin(), s.end()), s.end());
    triangles.push_back(s);
  }
  std::sort(triangles.begin(), triangles.end());
  triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
  return triangles;
}

} // namespace

TriangleMesh thinnedMesh(const TriangleMesh& mesh, std::size_t most_triangles) {
  TriangleMesh thinned = mesh;
  thinned.normals.clear();
  double area = 0.0;
  for (const Triangle& t : mesh.triangles) {
    const Vector3& a = mesh.vertices[static_cast<std::size_t>(t[0])];
    const Vector3 u = mesh.vertices[static_cast<std::size_t>(t[1])] - a;
    const Vector3 v = mesh.vertices[static_cast<std::size_t>(t[2])] - a;
    area += 0.5 * std::abs(u.x() * v.y() - u.y() * v.x());
  }
  double cell = std::sqrt(2.0 * area / static_cast<double>(std::max<std::size_t>(most_triangles, 1)));
  while (thinned.triangles.size() > std::max<std::size_t>(most_triangles, 2) && cell > 0.0) {
    thinned.triangles = trianglesOf(mesh, standIns(mesh, cell));
    cell *= kGrowth;
  }
  removeUnreferencedVertices(thinned);
  return thinned;
}

} // namespace graben
