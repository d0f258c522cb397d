#include "graben/mesh/adjacency.h"

#include "graben/core/threads.h"

#include <algorithm>

namespace graben {

namespace {

/// A half-edge as its lower vertex sees it.
struct EdgeEntry {
  Index high;
  Index half_edge;
  bool operator<(const EdgeEntry& other) const {
    return high != other.high ? high < other.high : half_edge < other.half_edge;
  }
};

Index startOf(const TriangleMesh& mesh, Index half_edge) {
  return mesh
      .triangles[static_cast<std::size_t>(half_edge / 3)][static_cast<std::size_t>(half_edge % 3)];
}

Index nextInTriangle(Index half_edge) {
  return half_edge % 3 == 2 ? half_edge - 2 : half_edge + 1;
}

bool repeatsVertex(const Triangle& t) {
  return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

/// The half-edges of proper triangles of which \a v is the lower vertex, sorted by edge.
void listEdges(const TriangleMesh& mesh, VertexCorners::Range corners, Index v, std::vector<EdgeEntry>& edges) {
  edges.clear();
  for (const Index c : corners) {
    const Triangle& t = mesh.triangles[static_cast<std::size_t>(c / 3)];
    if (repeatsVertex(t))
      continue;
    const auto e = static_cast<std::size_t>(c % 3);
    if (const Index next = t[(e + 1) % 3]; next > v)
      edges.push_back({next, c});
    if (const Index previous = t[(e + 2) % 3]; previous > v)
      edges.push_back({previous, e == 0 ? c + 2 : c - 1});
  }
  std::sort(edges.begin(), edges.end());
}

} // namespace

EdgeAdjacency::EdgeAdjacency(const TriangleMesh& mesh, unsigned threads)
    : EdgeAdjacency(mesh, VertexCorners(mesh, threads), threads) {}

EdgeAdjacency::EdgeAdjacency(const TriangleMesh& mesh, const VertexCorners& corners, unsigned threads)
    : twin_(3 * mesh.triangles.size(), kNonManifold) {
  parallelBlocks(mesh.vertices.size(), 4096, threads, [&](std::size_t begin, std::size_t end) {
    std::vector<EdgeEntry> edges;
    for (std::size_t v = begin; v < end; ++v) {
      listEdges(mesh, corners.of(v), static_cast<Index>(v), edges);
      for (std::size_t i = 0, j = 0; i < edges.size(); i = j) {
        while (j < edges.size() && edges[j].high == edges[i].high)
          ++j;
        const Index h = edges[i].half_edge;
        if (j - i == 1) {
          twin_[static_cast<std::size_t>(h)] = kBorder;
        } else if (j - i == 2 && startOf(mesh, h) != startOf(mesh, edges[i + 1].half_edge)) {
          const Index other = edges[i + 1].half_edge;
          twin_[static_cast<std::size_t>(h)] = other;
          twin_[static_cast<std::size_t>(other)] = h;
        }
      }
    }
  });
}

Index twinOf(const TriangleMesh& mesh, VertexCorners::Range corners_at_an_end, Index half_edge) {
  const Index own = half_edge / 3;
  if (repeatsVertex(mesh.triangles[static_cast<std::size_t>(own)]))
    return EdgeAdjacency::kNonManifold;
  const Index from = startOf(mesh, half_edge);
  const Index to = startOf(mesh, nextInTriangle(half_edge));
  Index twin = EdgeAdjacency::kBorder;
  for (const Index corner : corners_at_an_end) {
    const Index t = corner / 3;
    if (t == own || repeatsVertex(mesh.triangles[static_cast<std::size_t>(t)]))
      continue;
    for (Index h = 3 * t; h < 3 * t + 3; ++h) {
      const Index start = startOf(mesh, h);
      const Index end = startOf(mesh, nextInTriangle(h));
      if ((start == from && end == to) || (start == to && end == from && twin != EdgeAdjacency::kBorder))
        return EdgeAdjacency::kNonManifold;
      if (start == to && end == from)
        twin = h;
    }
  }
  return twin;
}

std::vector<std::vector<Index>> borderLoops(const TriangleMesh& mesh,
                                            const EdgeAdjacency& adjacency) {
  std::vector<std::vector<Index>> loops;
  const auto half_edges = static_cast<Index>(3 * mesh.triangles.size());
  std::vector<bool> done(static_cast<std::size_t>(half_edges), false);
  for (Index start = 0; start < half_edges; ++start) {
    if (!adjacency.isBorder(start) || done[static_cast<std::size_t>(start)])
      continue;
    std::vector<Index>& loop = loops.emplace_back();
    Index h = start;
    do {
      done[static_cast<std::size_t>(h)] = true;
      loop.push_back(startOf(mesh, h));
      h = nextInTriangle(h);
      while (adjacency.twin(h) >= 0)
        h = nextInTriangle(adjacency.twin(h));
    } while (h != start);
  }
  return loops;
}

} // namespace graben
