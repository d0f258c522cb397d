#include "graben/analysis/topology.h"

#include "graben/core/threads.h"
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

/// The vertex of half-edge h's triangle that h does not touch.
Index apexOf(const TriangleMesh& mesh, Index h) {
  return mesh.triangles[cornerOf(h / 3)][cornerOf(previousInTriangle(h) % 3)];
}

/// True if a triangle may have the same vertices as another: then it shares each of its edges with the other, as twin or as one too many.
bool mayRepeat(const TriangleMesh& mesh, const EdgeAdjacency& adjacency, std::size_t triangle) {
  for (Index h = static_cast<Index>(3 * triangle), end = h + 3; h < end; ++h) {
    const Index twin = adjacency.twin(h);
    if (twin == EdgeAdjacency::kNonManifold || (twin >= 0 && apexOf(mesh, twin) == apexOf(mesh, h)))
      return true;
  }
  return false;
}

std::size_t countDuplicates(const TriangleMesh& mesh, const EdgeAdjacency& adjacency) {
  std::vector<Triangle> sorted;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (mayRepeat(mesh, adjacency, t))
      sorted.push_back(mesh.triangles[t]);
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

void countEdges(const TriangleMesh& mesh, const EdgeAdjacency& adjacency, TopologyReport& report) {
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
  report.duplicate_triangles = countDuplicates(mesh, adjacency);
}

void countComponents(const TriangleMesh& mesh, TopologyReport& report) {
  const Components components = connectedComponents(mesh);
  report.components = components.triangle_count.size();
  for (const std::size_t count : components.triangle_count)
    report.crumbs += count < kCrumbTriangles ? 1 : 0;
  report.unreferenced_vertices =
    static_cast<std::size_t>(std::count(components.of_vertex.begin(), components.of_vertex.end(), -1));
}

std::size_t countDegenerate(const TriangleMesh& mesh, unsigned threads) {
  constexpr std::size_t kGrain = 1 << 14;
  const double diagonal = boundsOf(mesh.vertices).diagonal();
  std::vector<std::size_t> counts((mesh.triangles.size() + kGrain - 1) / kGrain, 0);
  parallelFor(mesh.triangles.size(), kGrain, threads,
              [&](std::size_t t) { counts[t / kGrain] += isDegenerate(mesh, mesh.triangles[t], diagonal) ? 1 : 0; });
  return std::accumulate(counts.begin(), counts.end(), std::size_t{0});
}

} // namespace

TopologyReport checkTopology(const TriangleMesh& mesh, unsigned threads) {
  validate(mesh, "checking the topology", threads);
  TopologyReport report;
  report.vertices = mesh.vertices.size();
  report.triangles = mesh.triangles.size();
  report.degenerate_triangles = countDegenerate(mesh, threads);
  const EdgeAdjacency adjacency(mesh, threads);
  // Two searches that go from triangle to triangle: each on a thread of its own.
  parallelFor(2, 1, threads, [&](std::size_t task) {
    if (task == 0)
      countEdges(mesh, adjacency, report);
    else
      countComponents(mesh, report);
  });
  return report;
}

} // namespace graben
