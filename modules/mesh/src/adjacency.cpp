#include "graben/mesh/adjacency.h"

#include "group_by_vertex.h"

#include <algorithm>
#include <cstdint>

namespace graben {

namespace {

/// A half-edge listed at the lower of its two vertices.
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

/// All half-edges of proper triangles, at their lower vertices.
detail::ByVertex<EdgeEntry> edgesByVertex(const TriangleMesh& mesh, unsigned threads) {
  return detail::groupByVertex<EdgeEntry>(mesh, threads, [&mesh](std::size_t t, const auto& put) {
    const Triangle& triangle = mesh.triangles[t];
    if (repeatsVertex(triangle))
      return;
    for (std::size_t e = 0; e < 3; ++e) {
      const auto [low, high] = std::minmax(triangle[e], triangle[(e + 1) % 3]);
      put(low, EdgeEntry{high, static_cast<Index>(3 * t + e)});
    }
  });
}

} // namespace

EdgeAdjacency::EdgeAdjacency(const TriangleMesh& mesh, unsigned threads)
    : twin_(3 * mesh.triangles.size(), kNonManifold) {
  auto [first, entries] = edgesByVertex(mesh, threads);
  parallelFor(mesh.vertices.size(), 4096, threads, [&, &first = first, &entries = entries](std::size_t v) {
    const std::uint32_t end = first[v + 1];
    std::sort(entries.begin() + first[v], entries.begin() + end);
    for (std::uint32_t i = first[v], j = i; i < end; i = j) {
      while (j < end && entries[j].high == entries[i].high)
        ++j;
      const Index h = entries[i].half_edge;
      if (j - i == 1) {
        twin_[static_cast<std::size_t>(h)] = kBorder;
      } else if (j - i == 2 && startOf(mesh, h) != startOf(mesh, entries[i + 1].half_edge)) {
        const Index other = entries[i + 1].half_edge;
        twin_[static_cast<std::size_t>(h)] = other;
        twin_[static_cast<std::size_t>(other)] = h;
      }
    }
  });
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
