#include "graben/mesh/vertex_corners.h"

#include "graben/core/threads.h"

#include <algorithm>

namespace graben {

namespace {

/// Calls take(vertex, corner) for each corner, those of a vertex in rising order and by one thread: up to eight go through all triangles, each for
/// vertices of its own.
template <typename Take>
void visitCorners(const TriangleMesh& mesh, unsigned threads, const Take& take) {
  constexpr std::size_t kMostParts = 8;
  constexpr std::size_t kSmall = 1 << 14;
  const std::size_t parts = mesh.triangles.size() < kSmall ? 1 : std::min<std::size_t>(threadCount(threads), kMostParts);
  const std::size_t vertices = mesh.vertices.size();
  parallelFor(parts, 1, threads, [&](std::size_t part) {
    const std::size_t begin = vertices * part / parts;
    const std::size_t count = vertices * (part + 1) / parts - begin;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      for (std::size_t e = 0; e < 3; ++e) {
        const auto vertex = static_cast<std::size_t>(mesh.triangles[t][e]);
        if (vertex - begin < count)
          take(vertex, static_cast<Index>(3 * t + e));
      }
  });
}

} // namespace

VertexCorners::VertexCorners(const TriangleMesh& mesh, unsigned threads) {
  const std::size_t vertices = mesh.vertices.size();
  first_.assign(vertices + 1, 0);
  visitCorners(mesh, threads, [this](std::size_t v, Index) { ++first_[v + 1]; });
  for (std::size_t v = 0; v < vertices; ++v)
    first_[v + 1] += first_[v];
  corners_.reset(new Index[first_.back()]);
  // The start of each group wanders to its end, which is the start of the next.
  visitCorners(mesh, threads, [this](std::size_t v, Index corner) { corners_[first_[v]++] = corner; });
  for (std::size_t v = vertices; v > 0; --v)
    first_[v] = first_[v - 1];
  first_[0] = 0;
}

} // namespace graben
