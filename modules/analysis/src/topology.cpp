#include "graben/analysis/topology.h"

#include "graben/mesh/adjacency.h"
#include "graben/mesh/bounds.h"
#include "graben/mesh/components.h"
#include "graben/mesh/normals.h"

#include <algorithm>
#include <numeric>

namespace graben {

namespace {

constexpr double kThin = 1e-10;  ///< smallest height over longest edge
constexpr double kPoint = 1e-12; ///< longest edge over bounding diagonal

std::size_t cornerOf(Index half_edge) {
  return static_cast<std::size_t>(half_edge);
}
Index nextInTriangle(Index h) {
  return h % 3 == 2 ? h - 2 : h + 1;
}
Index previousInTriangle(Index h) {
  return h % 3 == 0 ? h + 2 : h - 1;
}

bool repeatsVertex(const Triangle& t) {
  return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

bool isDegenerate(const TriangleMesh& mesh, const Triangle& t, double diagonal) {
  if (repeatsVertex(t))
    return true;
  double longest2 = 0.0;
  for (std::size_t e = 0; e < 3; ++e)
    longest2 = std::max(longest2, (mesh.vertices[static_cast<std::size_t>(t[e])] -
                                   mesh.vertices[static_cast<std::size_t>(t[(e + 1) % 3])])
                                      .squaredNorm());
  return longest2 <= kPoint * kPoint * diagonal * diagonal ||
         areaNormal(mesh, t).norm() <= kThin * longest2;
}

std::size_t countDuplicates(const TriangleMesh& mesh) {
  std::vector<Triangle> sorted = mesh.triangles;
  for (Triangle& t : sorted)
    std::sort(t.begin(), t.end());
  std::sort(sorted.begin(), sorted.end());
  return sorted.size() -
         static_cast<std::size_t>(std::unique(sorted.begin(), sorted.end()) - sorted.begin());
}

/// A half-edge on an edge that is not manifold.
struct BadEdge {
  Index low, high, half_edge;
  bool sameEdge(const BadEdge& other) const { return low == other.low && high == other.high; }
  bool operator<(const BadEdge& other) const {
    return std::array<Index, 3>{low, high, half_edge} <
           std::array<Index, 3>{other.low, other.high, other.half_edge};
  }
};

std::vector<BadEdge> badEdges(const TriangleMesh& mesh, const EdgeAdjacency& adjacency) {
  std::vector<BadEdge> result;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle& triangle = mesh.triangles[t];
    if (repeatsVertex(triangle))
      continue;
    for (std::size_t e = 0; e < 3; ++e) {
      const auto h = static_cast<Index>(3 * t + e);
      if (adjacency.twin(h) != EdgeAdjacency::kNonManifold)
        continue;
      const auto [low, high] = std::minmax(triangle[e], triangle[(e + 1) % 3]);
      result.push_back({low, high, h});
    }
  }
  std::sort(result.begin(), result.end());
  return result;
}

/// Sets of triangle corners (named by the half-edge that starts there) that meet at a vertex and
/// share edges.
class CornerSets {
public:
  explicit CornerSets(std::size_t corners)
      : parent_(corners) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  Index find(Index c) {
    while (parent_[cornerOf(c)] != c) {
      parent_[cornerOf(c)] = parent_[cornerOf(parent_[cornerOf(c)])];
      c = parent_[cornerOf(c)];
    }
    return c;
  }
  void join(Index a, Index b) {
    a = find(a);
    b = find(b);
    parent_[cornerOf(std::max(a, b))] = std::min(a, b);
  }

private:
  std::vector<Index> parent_;
};

/// The corner of half-edge h's triangle at \a vertex, one of h's ends.
Index cornerAt(const TriangleMesh& mesh, Index h, Index vertex) {
  return mesh.triangles[static_cast<std::size_t>(h / 3)][static_cast<std::size_t>(h % 3)] == vertex
             ? h
             : nextInTriangle(h);
}

std::size_t countBowTies(const TriangleMesh& mesh, const EdgeAdjacency& adjacency,
                         const std::vector<BadEdge>& bad) {
  const auto corners = static_cast<Index>(3 * mesh.triangles.size());
  CornerSets sets(static_cast<std::size_t>(corners));
  for (Index c = 0; c < corners; ++c) {
    const Index twin = adjacency.twin(previousInTriangle(c));
    if (twin >= 0)
      sets.join(c, twin);
  }
  for (std::size_t i = 1; i < bad.size(); ++i)
    if (bad[i].sameEdge(bad[i - 1]))
      for (const Index v : {bad[i].low, bad[i].high})
        sets.join(cornerAt(mesh, bad[i].half_edge, v), cornerAt(mesh, bad[i - 1].half_edge, v));
  std::vector<Index> first_set(mesh.vertices.size(), -1);
  std::vector<bool> bow_tie(mesh.vertices.size(), false);
  for (Index c = 0; c < corners; ++c) {
    const Triangle& triangle = mesh.triangles[static_cast<std::size_t>(c / 3)];
    if (repeatsVertex(triangle))
      continue;
    const auto v = static_cast<std::size_t>(triangle[static_cast<std::size_t>(c % 3)]);
    const Index set = sets.find(c);
    if (first_set[v] < 0)
      first_set[v] = set;
    else if (first_set[v] != set)
      bow_tie[v] = true;
  }
  return static_cast<std::size_t>(std::count(bow_tie.begin(), bow_tie.end(), true));
}

void countEdges(const TriangleMesh& mesh, TopologyReport& report) {
  const EdgeAdjacency adjacency(mesh);
  for (Index h = 0; h < static_cast<Index>(3 * mesh.triangles.size()); ++h)
    report.border_edges += adjacency.isBorder(h) ? 1 : 0;
  report.border_loops = borderLoops(mesh, adjacency).size();
  const std::vector<BadEdge> bad = badEdges(mesh, adjacency);
  for (std::size_t i = 0, j = 0; i < bad.size(); i = j) {
    while (j < bad.size() && bad[j].sameEdge(bad[i]))
      ++j;
    ++(j - i > 2 ? report.non_manifold_edges : report.inconsistent_edges);
  }
  report.non_manifold_vertices = countBowTies(mesh, adjacency, bad);
}

} // namespace

TopologyReport checkTopology(const TriangleMesh& mesh) {
  validate(mesh, "checking the topology");
  TopologyReport report;
  report.vertices = mesh.vertices.size();
  report.triangles = mesh.triangles.size();
  const double diagonal = boundsOf(mesh.vertices).diagonal();
  for (const Triangle& triangle : mesh.triangles)
    report.degenerate_triangles += isDegenerate(mesh, triangle, diagonal) ? 1 : 0;
  report.duplicate_triangles = countDuplicates(mesh);
  const Components components = connectedComponents(mesh);
  report.components = components.triangle_count.size();
  for (const std::size_t count : components.triangle_count)
    report.crumbs += count < kCrumbTriangles ? 1 : 0;
  report.unreferenced_vertices = static_cast<std::size_t>(
      std::count(components.of_vertex.begin(), components.of_vertex.end(), -1));
  countEdges(mesh, report);
  return report;
}

} // namespace graben
