#include "face_fan.h"

#include "cell_fields.h"
#include "fault_tears.h"

#include "graben/core/sort_unique.h"

#include <algorithm>
#include <map>
#include <tuple>

namespace graben {

namespace {

/// What tells parts of surfaces apart.
using PartKey = std::tuple<Index, Index, Index>;

/// 0 to 5: a face of the box; beyond: what else bounds the model.
Index wallOf(const LabelledCells& cells, std::size_t cell, int face, const Bounds& box) {
  const std::int16_t mark = cells.mesh.marks[cell][static_cast<std::size_t>(face)];
  if (mark < -1)
    return 6 - mark;
  unsigned walls = ~0U;
  for (const int corner : kTetrahedronFaces[static_cast<std::size_t>(face)])
    walls &= wallsOf(cells.mesh.position(cells.mesh.cells[cell][static_cast<std::size_t>(corner)]), box);
  Index wall = 0;
  while (wall < 5 && (walls >> wall & 1U) == 0)
    ++wall;
  return wall;
}

} // namespace

FacedCells::FacedCells(LabelledCells& labelled, const CellNeighbors& neighbors, const Bounds& box) : cells(labelled) {
  const TetrahedronMesh& mesh = cells.mesh;
  part.assign(mesh.cells.size(), {-1, -1, -1, -1});
  gone.assign(mesh.cells.size(), 0);
  std::map<PartKey, Index> parts;
  std::vector<std::uint8_t> on_part(mesh.vertices.size(), 0);
  for (std::size_t c = 0; c < part.size(); ++c)
    for (int f = 0; f < 4; ++f) {
      const Index behind = neighbors.behind(c, f);
      const std::int16_t mark = mesh.marks[c][static_cast<std::size_t>(f)];
      PartKey key;
      if (behind < 0) {
        key = {-1 - wallOf(cells, c, f, box), cells.block[c], -1};
      } else {
        const Index other = cells.block[static_cast<std::size_t>(behind / 4)];
        if (mark < 0 && other == cells.block[c])
          continue;
        key = {mark < 0 ? 0 : 1 + faultOf(mark), std::min(other, cells.block[c]), std::max(other, cells.block[c])};
      }
      part[c][static_cast<std::size_t>(f)] = parts.emplace(key, static_cast<Index>(parts.size())).first->second;
      for (const int corner : kTetrahedronFaces[static_cast<std::size_t>(f)])
        on_part[static_cast<std::size_t>(mesh.cells[c][static_cast<std::size_t>(corner)])] = 1;
    }
  around.resize(mesh.vertices.size());
  for (std::size_t c = 0; c < part.size(); ++c)
    for (const Index v : mesh.cells[c])
      if (on_part[static_cast<std::size_t>(v)] != 0)
        around[static_cast<std::size_t>(v)].push_back(static_cast<Index>(c));
}

Index FacedCells::cellWith(Index a, Index b, Index c, Index but) const {
  for (const Index candidate : around[static_cast<std::size_t>(a)])
    if (candidate != but && gone[static_cast<std::size_t>(candidate)] == 0 && cornerOf(cell(candidate), a) >= 0 && cornerOf(cell(candidate), b) >= 0 &&
        cornerOf(cell(candidate), c) >= 0)
      return candidate;
  return -1;
}

FaceFan::FaceFan(const FacedCells& faced, Index vertex) {
  for (const Index c : faced.around[static_cast<std::size_t>(vertex)]) {
    if (faced.gone[static_cast<std::size_t>(c)] != 0)
      continue;
    const Tetrahedron& cell = faced.cell(c);
    const int mine = FacedCells::cornerOf(cell, vertex);
    for (int f = 0; f < 4; ++f) {
      const Index part = faced.part[static_cast<std::size_t>(c)][static_cast<std::size_t>(f)];
      if (f == mine || part < 0)
        continue;
      std::array<Index, 2> others{};
      std::size_t n = 0;
      for (int i = 0; i < 4; ++i)
        if (i != mine && i != f)
          others[n++] = cell[static_cast<std::size_t>(i)];
      faces.push_back({std::min(others[0], others[1]), std::max(others[0], others[1]), part});
    }
  }
  sortUnique(faces);
  if (faces.empty())
    return;
  std::vector<std::pair<Index, Index>> edges; // neighbour, part
  for (const FanFace& face : faces) {
    edges.emplace_back(face.p, face.part);
    edges.emplace_back(face.q, face.part);
  }
  std::sort(edges.begin(), edges.end());
  std::vector<std::vector<Index>> parts_at_line;
  for (std::size_t i = 0, end = 0; i < edges.size(); i = end) {
    std::vector<Index> parts;
    for (end = i; end < edges.size() && edges[end].first == edges[i].first; ++end)
      parts.push_back(edges[end].second);
    neighbors.push_back(edges[i].first);
    if (parts.size() == 2 && parts[0] == parts[1])
      continue;
    line.push_back(edges[i].first);
    parts_at_line.push_back(std::move(parts));
  }
  if (line.empty()) {
    // one round of faces, or several that touch in the vertex
    std::size_t steps = 0;
    Index at = faces.front().p, from = faces.front().q;
    const Index first = from;
    do {
      const auto next = std::find_if(faces.begin(), faces.end(), [&](const FanFace& f) { return (f.p == at && f.q != from) || (f.q == at && f.p != from); });
      if (next == faces.end())
        break;
      from = std::exchange(at, next->p == at ? next->q : next->p);
      ++steps;
    } while (from != first && steps <= faces.size());
    kind = steps == faces.size() && neighbors.size() == faces.size() ? Kind::Surface : Kind::Corner;
    return;
  }
  kind = line.size() == 2 && parts_at_line[0] == parts_at_line[1] ? Kind::Line : Kind::Corner;
}

} // namespace graben
