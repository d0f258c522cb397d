#include "graben/mesh/tetrahedron_mesh.h"

#include "graben/core/threads.h"

#include <algorithm>

namespace graben {

namespace {

using Corners = std::array<Index, 3>;

/// The vertices of a face in rising order.
Corners cornersOf(const TetrahedronMesh& mesh, std::size_t face) {
  const Tetrahedron& cell = mesh.cells[face / 4];
  const auto& corners = kTetrahedronFaces[face % 4];
  Index a = mesh.vertexOf(cell[static_cast<std::size_t>(corners[0])]);
  Index b = mesh.vertexOf(cell[static_cast<std::size_t>(corners[1])]);
  Index c = mesh.vertexOf(cell[static_cast<std::size_t>(corners[2])]);
  if (a > b)
    std::swap(a, b);
  if (b > c)
    std::swap(b, c);
  if (a > b)
    std::swap(a, b);
  return {a, b, c};
}

struct Face {
  std::uint64_t others; ///< its second and third vertex
  Index number;
  bool operator<(const Face& o) const { return others != o.others ? others < o.others : number < o.number; }
};

} // namespace

CellNeighbors::CellNeighbors(const TetrahedronMesh& mesh, unsigned threads) : behind_(4 * mesh.cells.size(), kOutside) {
  const auto last = std::max_element(mesh.node_vertex.begin(), mesh.node_vertex.end());
  const std::size_t vertices = last == mesh.node_vertex.end() ? 0 : static_cast<std::size_t>(*last) + 1;
  std::vector<std::size_t> starts(vertices + 1, 0); // of the faces with each vertex as their lowest
  for (std::size_t f = 0; f < behind_.size(); ++f)
    ++starts[static_cast<std::size_t>(cornersOf(mesh, f)[0]) + 1];
  for (std::size_t v = 1; v < starts.size(); ++v)
    starts[v] += starts[v - 1];
  std::vector<Index> faces(behind_.size());
  std::vector<std::size_t> next(starts.begin(), starts.end() - 1);
  for (std::size_t f = 0; f < behind_.size(); ++f)
    faces[next[static_cast<std::size_t>(cornersOf(mesh, f)[0])]++] = static_cast<Index>(f);
  parallelBlocks(vertices, 4096, threads, [&](std::size_t begin, std::size_t end) {
    std::vector<Face> here;
    for (std::size_t v = begin; v < end; ++v) {
      here.clear();
      for (std::size_t i = starts[v]; i < starts[v + 1]; ++i) {
        const Corners corners = cornersOf(mesh, static_cast<std::size_t>(faces[i]));
        here.push_back({static_cast<std::uint64_t>(corners[1]) << 32 | static_cast<std::uint32_t>(corners[2]), faces[i]});
      }
      std::sort(here.begin(), here.end());
      for (std::size_t i = 0; i + 1 < here.size(); ++i)
        if (here[i].others == here[i + 1].others) {
          behind_[static_cast<std::size_t>(here[i].number)] = here[i + 1].number;
          behind_[static_cast<std::size_t>(here[i + 1].number)] = here[i].number;
        }
    }
  });
}

} // namespace graben
