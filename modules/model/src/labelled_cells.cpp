#include "labelled_cells.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <map>

namespace graben {

namespace {

double faceArea(const TetrahedronMesh& mesh, std::size_t cell, int face) {
  const auto& corners = kTetrahedronFaces[static_cast<std::size_t>(face)];
  const auto p = [&](std::size_t i) -> const Vector3& { return mesh.position(mesh.cells[cell][static_cast<std::size_t>(corners[i])]); };
  return 0.5 * (p(1) - p(0)).cross(p(2) - p(0)).norm();
}

struct Contact {
  double area = 0.0;    ///< without a fault between
  double across = 0.0;  ///< across faults
};

/// What each block below the limit shares with each of its neighbours.
std::map<std::pair<Index, Index>, Contact> contactsOf(const LabelledCells& cells, const CellNeighbors& neighbors, const std::vector<std::uint8_t>& small) {
  std::map<std::pair<Index, Index>, Contact> contacts;
  for (std::size_t c = 0; c < cells.block.size(); ++c) {
    if (small[static_cast<std::size_t>(cells.block[c])] == 0)
      continue;
    for (int f = 0; f < 4; ++f) {
      const Index behind = neighbors.behind(c, f);
      if (behind < 0 || cells.block[static_cast<std::size_t>(behind / 4)] == cells.block[c])
        continue;
      Contact& contact = contacts[{cells.block[c], cells.block[static_cast<std::size_t>(behind / 4)]}];
      (cells.mesh.marks[c][static_cast<std::size_t>(f)] < 0 ? contact.area : contact.across) += faceArea(cells.mesh, c, f);
    }
  }
  return contacts;
}

} // namespace

void keepCells(TetrahedronMesh& mesh, const std::vector<std::uint8_t>& kept, const std::function<std::int16_t(std::size_t cell)>& mark, unsigned threads) {
  const CellNeighbors neighbors(mesh, threads);
  std::size_t place = 0;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    if (kept[c] == 0)
      continue;
    std::array<std::int16_t, 4> marks = mesh.marks[c];
    for (int f = 0; f < 4; ++f) {
      const Index behind = neighbors.behind(c, f);
      if (behind >= 0 && kept[static_cast<std::size_t>(behind / 4)] == 0)
        marks[static_cast<std::size_t>(f)] = mark(static_cast<std::size_t>(behind / 4));
    }
    mesh.cells[place] = mesh.cells[c];
    mesh.marks[place++] = marks;
  }
  mesh.cells.resize(place);
  mesh.marks.resize(place);
}

double LabelledCells::volume(std::size_t cell) const {
  const auto p = [&](std::size_t i) -> const Vector3& { return mesh.position(mesh.cells[cell][i]); };
  return (p(1) - p(0)).cross(p(2) - p(0)).dot(p(3) - p(0)) / 6.0;
}

void labelBlocks(LabelledCells& cells, const CellNeighbors& neighbors) {
  cells.block.assign(cells.layer.size(), -1);
  cells.blocks = 0;
  std::vector<std::size_t> reached;
  for (std::size_t c = 0; c < cells.block.size(); ++c) {
    if (cells.block[c] >= 0)
      continue;
    reached.assign(1, c);
    cells.block[c] = cells.blocks;
    while (!reached.empty()) {
      const std::size_t at = reached.back();
      reached.pop_back();
      for (int f = 0; f < 4; ++f) {
        const Index behind = neighbors.behind(at, f);
        if (behind < 0 || cells.mesh.marks[at][static_cast<std::size_t>(f)] >= 0)
          continue;
        const auto other = static_cast<std::size_t>(behind / 4);
        if (cells.block[other] >= 0 || cells.layer[other] != cells.layer[at])
          continue;
        cells.block[other] = cells.blocks;
        reached.push_back(other);
      }
    }
    ++cells.blocks;
  }
}

std::size_t joinSlivers(LabelledCells& cells, const CellNeighbors& neighbors, double limit) {
  std::vector<double> volume(static_cast<std::size_t>(cells.blocks), 0.0);
  std::vector<Index> layer(volume.size(), 0);
  for (std::size_t c = 0; c < cells.block.size(); ++c) {
    volume[static_cast<std::size_t>(cells.block[c])] += cells.volume(c);
    layer[static_cast<std::size_t>(cells.block[c])] = cells.layer[c];
  }
  std::vector<std::uint8_t> small(volume.size());
  for (std::size_t b = 0; b < volume.size(); ++b)
    small[b] = volume[b] < limit ? 1 : 0;
  std::vector<Index> into(volume.size());
  for (std::size_t b = 0; b < into.size(); ++b)
    into[b] = static_cast<Index>(b);
  const auto root = [&into](Index b) {
    while (into[static_cast<std::size_t>(b)] != b)
      b = into[static_cast<std::size_t>(b)];
    return b;
  };
  std::size_t joined = 0;
  const auto contacts = contactsOf(cells, neighbors, small);
  std::vector<Index> order;
  for (std::size_t b = 0; b < small.size(); ++b)
    if (small[b] != 0)
      order.push_back(static_cast<Index>(b));
  const auto smaller = [&volume](Index a, Index b) { return volume[static_cast<std::size_t>(a)] < volume[static_cast<std::size_t>(b)]; };
  std::stable_sort(order.begin(), order.end(), smaller);
  for (const Index b : order) {
    Index best = -1;
    Contact most;
    for (auto it = contacts.lower_bound({b, -1}); it != contacts.end() && it->first.first == b; ++it) {
      const bool better = it->second.area > most.area || (it->second.area == most.area && it->second.across > most.across);
      if (root(it->first.second) != root(b) && (best < 0 || better)) {
        best = it->first.second;
        most = it->second;
      }
    }
    if (best < 0)
      continue;
    into[static_cast<std::size_t>(root(b))] = root(best);
    ++joined;
  }
  if (joined == 0)
    return 0;
  for (std::size_t c = 0; c < cells.block.size(); ++c) {
    cells.layer[c] = layer[static_cast<std::size_t>(root(cells.block[c]))];
    for (int f = 0; f < 4; ++f) { // no fault lies any longer between what was joined
      const Index behind = neighbors.behind(c, f);
      const Index other = behind < 0 ? cells.block[c] : cells.block[static_cast<std::size_t>(behind / 4)];
      if (other != cells.block[c] && root(other) == root(cells.block[c]))
        cells.mesh.marks[c][static_cast<std::size_t>(f)] = -1;
    }
  }
  labelBlocks(cells, neighbors);
  return joined;
}

} // namespace graben
