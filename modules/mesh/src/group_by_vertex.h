#pragma once

#include "graben/core/threads.h"
#include "graben/mesh/triangle_mesh.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace graben::detail {

/// Entries of a mesh's triangles grouped by vertex, in the order of the triangles: those of v are entries[first[v]] to entries[first[v + 1] - 1].
template <typename Entry>
struct ByVertex {
  std::vector<std::uint32_t> first;
  std::vector<Entry> entries;
};

/// \param[in] list    list(triangle, put) calls put(vertex, entry) for each entry of a triangle; called more than once for each
/// \param[in] threads 0: one per processor; up to eight go through all triangles, each for vertices of its own
template <typename Entry, typename List>
ByVertex<Entry> groupByVertex(const TriangleMesh& mesh, unsigned threads, const List& list) {
  const std::size_t vertices = mesh.vertices.size();
  constexpr std::size_t kMostParts = 8;
  constexpr std::size_t kSmall = 1 << 14;
  const std::size_t parts = mesh.triangles.size() < kSmall ? 1 : std::min<std::size_t>(threadCount(threads), kMostParts);
  ByVertex<Entry> result;
  result.first.assign(vertices + 1, 0);
  const auto visit = [&](const auto& take) {
    parallelFor(parts, 1, threads, [&](std::size_t part) {
      const std::size_t begin = vertices * part / parts;
      const std::size_t count = vertices * (part + 1) / parts - begin;
      for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        list(t, [&](Index vertex, const Entry& entry) {
          if (static_cast<std::size_t>(vertex) - begin < count)
            take(static_cast<std::size_t>(vertex), entry);
        });
    });
  };
  visit([&](std::size_t v, const Entry&) { ++result.first[v + 1]; });
  for (std::size_t v = 0; v < vertices; ++v)
    result.first[v + 1] += result.first[v];
  result.entries.resize(result.first.back());
  // The start of each group wanders to its end, which is the start of the next.
  visit([&](std::size_t v, const Entry& entry) { result.entries[result.first[v]++] = entry; });
  for (std::size_t v = vertices; v > 0; --v)
    result.first[v] = result.first[v - 1];
  result.first[0] = 0;
  return result;
}

} // namespace graben::detail
