#include "graben/mesh/components.h"

#include "graben/core/errors.h"
#include "graben/core/threads.h"

#include <algorithm>
#include <atomic>
#include <numeric>

namespace graben {

namespace {

constexpr std::size_t kGrain = 1 << 14;

/// Sets of vertices, each named by its lowest one, that several threads may join: a set's root is hung below the lower root of another, so that
/// the sets do not depend on who comes first.
class VertexSets {
public:
  VertexSets(std::size_t vertices, unsigned threads)
      : parent_(vertices) {
    parallelFor(vertices, kGrain, threads, [this](std::size_t v) { parent_[v].store(static_cast<Index>(v), std::memory_order_relaxed); });
  }

  Index rootOf(Index v) {
    for (;;) {
      Index up = at(v).load(std::memory_order_relaxed);
      if (up == v)
        return v;
      const Index above = at(up).load(std::memory_order_relaxed);
      if (above != up)
        at(v).compare_exchange_weak(up, above, std::memory_order_relaxed);
      v = above;
    }
  }

  void join(Index a, Index b) {
    for (;;) {
      a = rootOf(a);
      b = rootOf(b);
      if (a == b)
        return;
      Index higher = std::max(a, b);
      if (at(higher).compare_exchange_strong(higher, std::min(a, b), std::memory_order_relaxed))
        return;
    }
  }

private:
  std::atomic<Index>& at(Index v) { return parent_[static_cast<std::size_t>(v)]; }

  std::vector<std::atomic<Index>> parent_;
};

/// The lowest vertex of the component of each vertex.
std::vector<Index> rootsOf(const TriangleMesh& mesh, unsigned threads) {
  VertexSets sets(mesh.vertices.size(), threads);
  parallelFor(mesh.triangles.size(), kGrain, threads, [&](std::size_t t) {
    sets.join(mesh.triangles[t][0], mesh.triangles[t][1]);
    sets.join(mesh.triangles[t][0], mesh.triangles[t][2]);
  });
  std::vector<Index> roots(mesh.vertices.size());
  parallelFor(roots.size(), kGrain, threads, [&](std::size_t v) { roots[v] = sets.rootOf(static_cast<Index>(v)); });
  return roots;
}

/// Triangles of one component that follow each other.
struct Run {
  std::size_t root;
  std::size_t triangles;
};

/// All triangles in runs, in blocks.
template <typename RootOf>
std::vector<std::vector<Run>> runsOf(std::size_t triangles, unsigned threads, const RootOf& root_of) {
  std::vector<std::vector<Run>> blocks((triangles + kGrain - 1) / kGrain);
  parallelFor(triangles, kGrain, threads, [&](std::size_t t) {
    std::vector<Run>& runs = blocks[t / kGrain];
    const std::size_t root = root_of(t);
    if (runs.empty() || runs.back().root != root)
      runs.push_back({root, 0});
    ++runs.back().triangles;
  });
  return blocks;
}

} // namespace

Components connectedComponents(const TriangleMesh& mesh, unsigned threads) {
  const std::vector<Index> roots = rootsOf(mesh, threads);
  const auto rootOf = [&](std::size_t t) { return static_cast<std::size_t>(roots[static_cast<std::size_t>(mesh.triangles[t][0])]); };
  // Numbered by first triangle to begin with.
  std::vector<Index> number(mesh.vertices.size(), -1);
  std::vector<std::size_t> count;
  for (const std::vector<Run>& block : runsOf(mesh.triangles.size(), threads, rootOf))
    for (const Run& run : block) {
      Index& n = number[run.root];
      if (n < 0) {
        n = static_cast<Index>(count.size());
        count.push_back(0);
      }
      count[static_cast<std::size_t>(n)] += run.triangles;
    }
  std::vector<std::size_t> order(count.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&count](std::size_t a, std::size_t b) { return count[a] > count[b]; });
  std::vector<Index> rank(count.size());
  Components result;
  for (std::size_t i = 0; i < order.size(); ++i) {
    rank[order[i]] = static_cast<Index>(i);
    result.triangle_count.push_back(count[order[i]]);
  }
  result.of_triangle.resize(mesh.triangles.size());
  parallelFor(mesh.triangles.size(), kGrain, threads,
              [&](std::size_t t) { result.of_triangle[t] = rank[static_cast<std::size_t>(number[rootOf(t)])]; });
  result.of_vertex.resize(mesh.vertices.size());
  parallelFor(mesh.vertices.size(), kGrain, threads, [&](std::size_t v) {
    const Index n = number[static_cast<std::size_t>(roots[v])];
    result.of_vertex[v] = n < 0 ? -1 : rank[static_cast<std::size_t>(n)];
  });
  return result;
}

Components labelPieces(TriangleMesh& mesh, unsigned threads) {
  Components components = connectedComponents(mesh, threads);
  if (std::find(components.of_vertex.begin(), components.of_vertex.end(), -1) !=
      components.of_vertex.end())
    throw InvalidInputError(
        "labelling pieces",
        "the mesh has a vertex that no triangle uses; remove such vertices first");
  mesh.piece = components.of_vertex;
  return components;
}

std::vector<TriangleMesh> splitComponents(const TriangleMesh& mesh, const Components& components) {
  std::vector<TriangleMesh> parts(components.triangle_count.size());
  std::vector<Index> target(mesh.vertices.size(), -1);
  for (std::size_t c = 0; c < parts.size(); ++c)
    parts[c].triangles.reserve(components.triangle_count[c]);
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    if (components.of_vertex[v] < 0)
      continue;
    TriangleMesh& part = parts[static_cast<std::size_t>(components.of_vertex[v])];
    target[v] = static_cast<Index>(part.vertices.size());
    part.vertices.push_back(mesh.vertices[v]);
    if (!mesh.normals.empty())
      part.normals.push_back(mesh.normals[v]);
    if (!mesh.piece.empty())
      part.piece.push_back(mesh.piece[v]);
    for (const auto& scalar : mesh.scalars)
      if (!scalar.second.empty())
        part.scalars[scalar.first].push_back(scalar.second[v]);
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle& from = mesh.triangles[t];
    Triangle to{};
    for (std::size_t e = 0; e < 3; ++e)
      to[e] = target[static_cast<std::size_t>(from[e])];
    parts[static_cast<std::size_t>(components.of_triangle[t])].triangles.push_back(to);
  }
  return parts;
}

} // namespace graben
