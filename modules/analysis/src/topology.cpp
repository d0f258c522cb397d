#include "graben/analysis/topology.h"

#include "graben/core/threads.h"
#include "graben/mesh/bounds.h"
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

constexpr std::size_t kGrain = 1 << 14;

/// The sum of count(i) over [0, size).
template <typename Count>
std::size_t sumOf(std::size_t size, unsigned threads, const Count& count) {
  std::vector<std::size_t> sums((size + kGrain - 1) / kGrain, 0);
  parallelBlocks(size, kGrain, threads, [&](std::size_t begin, std::size_t end) {
    std::size_t sum = 0;
    for (std::size_t i = begin; i < end; ++i)
      sum += count(i);
    sums[begin / kGrain] = sum;
  });
  return std::accumulate(sums.begin(), sums.end(), std::size_t{0});
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

/// What one pass over the half-edges finds.
struct Census {
  std::size_t border_edges = 0;
  std::vector<BadEdge> bad_edges;
  std::vector<Triangle> may_repeat; ///< triangles that may have the same vertices as another

  void take(const TriangleMesh& mesh, const EdgeAdjacency& adjacency, std::size_t t) {
    const auto first = static_cast<Index>(3 * t);
    bool bad = false;
    for (Index h = first; h < first + 3; ++h) {
      border_edges += adjacency.isBorder(h) ? 1 : 0;
      bad = bad || adjacency.twin(h) == EdgeAdjacency::kNonManifold;
    }
    const Index twin = adjacency.twin(first);
    // A triangle with the same vertices is the twin over every edge that is manifold.
    if (bad || (twin >= 0 && twin / 3 == adjacency.twin(first + 1) / 3))
      may_repeat.push_back(mesh.triangles[t]);
    if (!bad || repeatsVertex(mesh.triangles[t]))
      return;
    for (std::size_t e = 0; e < 3; ++e)
      if (adjacency.twin(first + static_cast<Index>(e)) == EdgeAdjacency::kNonManifold) {
        const auto [low, high] = std::minmax(mesh.triangles[t][e], mesh.triangles[t][(e + 1) % 3]);
        bad_edges.push_back({low, high, first + static_cast<Index>(e)});
      }
  }

  void take(const Census& other) {
    border_edges += other.border_edges;
    bad_edges.insert(bad_edges.end(), other.bad_edges.begin(), other.bad_edges.end());
    may_repeat.insert(may_repeat.end(), other.may_repeat.begin(), other.may_repeat.end());
  }
};

Census takeCensus(const TriangleMesh& mesh, const EdgeAdjacency& adjacency, unsigned threads) {
  std::vector<Census> blocks((mesh.triangles.size() + kGrain - 1) / kGrain);
  parallelFor(mesh.triangles.size(), kGrain, threads, [&](std::size_t t) { blocks[t / kGrain].take(mesh, adjacency, t); });
  Census all;
  for (const Census& block : blocks)
    all.take(block);
  return all;
}

std::size_t countDuplicates(std::vector<Triangle> triangles) {
  for (Triangle& t : triangles)
    std::sort(t.begin(), t.end());
  std::sort(triangles.begin(), triangles.end());
  return triangles.size() - static_cast<std::size_t>(std::unique(triangles.begin(), triangles.end()) - triangles.begin());
}

/// How many corners the fan around corner \a c has: those reached from it over manifold edges.
std::size_t fanSize(const EdgeAdjacency& adjacency, Index c) {
  std::size_t size = 1;
  Index h = adjacency.twin(previousInTriangle(c));
  for (; h >= 0 && h != c; h = adjacency.twin(previousInTriangle(h)))
    ++size;
  if (h == c)
    return size;
  for (h = adjacency.twin(c); h >= 0; h = adjacency.twin(nextInTriangle(h)))
    ++size;
  return size;
}

/// True if the corners at a vertex, those of proper triangles, do not all hang together over edges.
bool fallsApart(const TriangleMesh& mesh, VertexCorners::Range corners) {
  const auto startOf = [&mesh](Index h) { return mesh.triangles[cornerOf(h / 3)][cornerOf(h % 3)]; };
  std::vector<std::pair<Index, std::size_t>> edges; // other end, corner
  std::size_t count = 0;
  for (const Index c : corners) {
    if (repeatsVertex(mesh.triangles[cornerOf(c / 3)]))
      continue;
    edges.emplace_back(startOf(nextInTriangle(c)), count);
    edges.emplace_back(startOf(previousInTriangle(c)), count);
    ++count;
  }
  std::sort(edges.begin(), edges.end());
  std::vector<std::size_t> set(count);
  std::iota(set.begin(), set.end(), std::size_t{0});
  std::size_t sets = count;
  for (std::size_t i = 1; i < edges.size(); ++i) {
    const std::size_t from = set[edges[i].second];
    const std::size_t to = set[edges[i - 1].second];
    if (edges[i].first != edges[i - 1].first || from == to)
      continue;
    std::replace(set.begin(), set.end(), from, to);
    --sets;
  }
  return sets > 1;
}

std::size_t countBowTies(const TriangleMesh& mesh, const MeshConnections& connections, unsigned threads) {
  return sumOf(mesh.vertices.size(), threads, [&](std::size_t v) -> std::size_t {
    const VertexCorners::Range corners = connections.corners.of(v);
    const auto count = static_cast<std::size_t>(corners.last - corners.first);
    return count > 1 && fanSize(connections.adjacency, *corners.first) < count && fallsApart(mesh, corners) ? 1 : 0;
  });
}

void countEdges(const TriangleMesh& mesh, const EdgeAdjacency& adjacency, unsigned threads, TopologyReport& report) {
  Census census = takeCensus(mesh, adjacency, threads);
  report.border_edges = census.border_edges;
  report.border_loops = census.border_edges > 0 ? borderLoops(mesh, adjacency).size() : 0;
  std::vector<BadEdge>& bad = census.bad_edges;
  std::sort(bad.begin(), bad.end());
  for (std::size_t i = 0, j = 0; i < bad.size(); i = j) {
    while (j < bad.size() && bad[j].sameEdge(bad[i]))
      ++j;
    ++(j - i > 2 ? report.non_manifold_edges : report.inconsistent_edges);
  }
  report.duplicate_triangles = countDuplicates(std::move(census.may_repeat));
}

void countComponents(const Components& components, TopologyReport& report) {
  report.components = components.triangle_count.size();
  for (const std::size_t count : components.triangle_count)
    report.crumbs += count < kCrumbTriangles ? 1 : 0;
  report.unreferenced_vertices =
    static_cast<std::size_t>(std::count(components.of_vertex.begin(), components.of_vertex.end(), -1));
}

} // namespace

TopologyReport checkTopology(const TriangleMesh& mesh, unsigned threads) {
  validate(mesh, "checking the topology", threads);
  return checkTopology(mesh, MeshConnections(mesh, threads), connectedComponents(mesh, threads), threads);
}

TopologyReport checkTopology(const TriangleMesh& mesh, const MeshConnections& connections, const Components& components, unsigned threads) {
  TopologyReport report;
  report.vertices = mesh.vertices.size();
  report.triangles = mesh.triangles.size();
  const double diagonal = boundsOf(mesh.vertices, threads).diagonal();
  report.degenerate_triangles =
    sumOf(mesh.triangles.size(), threads, [&](std::size_t t) -> std::size_t { return isDegenerate(mesh, mesh.triangles[t], diagonal) ? 1 : 0; });
  countEdges(mesh, connections.adjacency, threads, report);
  report.non_manifold_vertices = countBowTies(mesh, connections, threads);
  countComponents(components, report);
  return report;
}

} // namespace graben
