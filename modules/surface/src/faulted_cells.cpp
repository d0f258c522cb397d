#include "faulted_cells.h"

#include "graben/core/threads.h"
#include "graben/faults/fault_signature.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace graben {

namespace {

std::uint64_t edgeKey(const LatticeIndex& low, int axis) {
  return (latticeKey(low) << 2) | static_cast<std::uint64_t>(axis);
}

LatticeIndex axisStep(int axis) { return {axis == 0 ? 1 : 0, axis == 1 ? 1 : 0, axis == 2 ? 1 : 0}; }

/// Groups of corners joined by edges that no fault crosses; the group of a corner is its lowest corner.
std::array<int, 8> cornerGroups(const std::array<std::uint64_t, 12>& crossed) {
  std::array<int, 8> group{};
  std::iota(group.begin(), group.end(), 0);
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t e = 0; e < 12; ++e) {
      if (crossed[e] != 0)
        continue;
      int& a = group[static_cast<std::size_t>(cube::kEdge[e][0])];
      int& b = group[static_cast<std::size_t>(cube::kEdge[e][1])];
      if (a != b) {
        a = b = std::min(a, b);
        changed = true;
      }
    }
  }
  return group;
}

/// What lies between a group and every other corner: exclusive-or of the crossings along the shortest way over the cell's edges.
std::array<std::uint64_t, 8> signaturesFrom(int group, const std::array<int, 8>& groups,
                                            const std::array<std::uint64_t, 12>& crossed) {
  std::array<std::uint64_t, 8> signature{};
  std::array<bool, 8> known{};
  for (std::size_t c = 0; c < 8; ++c)
    known[c] = groups[c] == group;
  for (int round = 0; round < 4; ++round) {
    const std::array<bool, 8> before = known;
    for (std::size_t e = 0; e < 12; ++e) {
      for (std::size_t way = 0; way < 2; ++way) {
        const auto from = static_cast<std::size_t>(cube::kEdge[e][way]);
        const auto to = static_cast<std::size_t>(cube::kEdge[e][1 - way]);
        if (before[from] && !known[to]) {
          known[to] = true;
          signature[to] = signature[from] ^ crossed[e];
        }
      }
    }
  }
  return signature;
}

/// Lattice vertices around one, in sets; used for the groups of the eight cells that share it.
class VertexSets {
public:
  explicit VertexSets(const LatticeIndex& middle) : middle_(middle) { std::iota(parent_.begin(), parent_.end(), 0); }

  void join(const LatticeIndex& a, const LatticeIndex& b) {
    const int p = find(slot(a));
    const int q = find(slot(b));
    parent_[static_cast<std::size_t>(std::max(p, q))] = std::min(p, q);
    used_[static_cast<std::size_t>(slot(a))] = used_[static_cast<std::size_t>(slot(b))] = true;
  }

  /// The first vertex in lattice order that is in the set of \a of.
  LatticeIndex first(const LatticeIndex& of) const { return at(find(slot(of))); }

  /// The first vertex in lattice order of all that were joined to anything.
  LatticeIndex first() const { return at(static_cast<int>(std::find(used_.begin(), used_.end(), true) - used_.begin())); }

private:
  int slot(const LatticeIndex& p) const {
    const LatticeIndex d = p - middle_;
    return 9 * (d.i + 1) + 3 * (d.j + 1) + d.k + 1;
  }
  LatticeIndex at(int slot) const { return middle_ + LatticeIndex{slot / 9 - 1, slot / 3 % 3 - 1, slot % 3 - 1}; }
  int find(int s) const {
    while (parent_[static_cast<std::size_t>(s)] != s)
      s = parent_[static_cast<std::size_t>(s)];
    return s;
  }

  LatticeIndex middle_;
  std::array<int, 27> parent_{};
  std::array<bool, 27> used_{};
};

} // namespace

void FaultedCells::findCrossings(const std::vector<LatticeIndex>& cells) {
  for (const LatticeIndex& cell : cells)
    for (std::size_t e = 0; e < 12; ++e)
      want(cell + cube::kCorner[static_cast<std::size_t>(cube::kEdgeLow[e])], static_cast<std::size_t>(cube::kEdgeAxis[e]));
  findWanted();

  // Whether a corner seen through a fault lies beside a tip depends on all cells around it.
  for (const LatticeIndex& cell : cells) {
    if (!isCrossed(cell))
      continue;
    for (int i = -1; i <= 2; ++i)
      for (int j = -1; j <= 2; ++j)
        for (int k = -1; k <= 2; ++k)
          for (std::size_t axis = 0; axis < 3; ++axis)
            if ((axis == 0 ? i : axis == 1 ? j : k) < 2)
              want(cell + LatticeIndex{i, j, k}, axis);
  }
  findWanted();
}

std::size_t FaultedCells::makeBlock(const LatticeIndex& at) {
  if (last_made_ < blocks_.size() && blocks_[last_made_].at == at)
    return last_made_;
  last_made_ = static_cast<std::size_t>(block_.add(latticeKey(at), static_cast<Index>(blocks_.size())));
  if (last_made_ == blocks_.size()) {
    blocks_.emplace_back();
    blocks_.back().at = at;
  }
  return last_made_;
}

void FaultedCells::want(const LatticeIndex& low, std::size_t axis) {
  const std::size_t b = makeBlock(block::blockOf(low));
  EdgeBlock& of = blocks_[b];
  const BlockMask edge = block::bit(block::slotOf(low));
  if (((of.asked[axis] | of.wanted[axis]) & edge) != 0)
    return;
  if ((of.wanted[0] | of.wanted[1] | of.wanted[2]) == 0)
    wanted_.push_back(b);
  of.wanted[axis] |= edge;
}

void FaultedCells::findWanted() {
  std::vector<std::vector<std::pair<EdgeKey, std::uint64_t>>> found(wanted_.size());
  parallelFor(wanted_.size(), 8, threads_, [&](std::size_t i) {
    const EdgeBlock& of = blocks_[wanted_[i]];
    for (int axis = 0; axis < 3; ++axis)
      for (BlockMask rest = of.wanted[static_cast<std::size_t>(axis)]; rest != 0; rest &= rest - 1) {
        const LatticeIndex low = block::vertexOf(of.at, block::lowest(rest));
        const std::uint64_t signature = faultSignature(faults_, lattice_.position(low), lattice_.position(low + axisStep(axis)));
        if (signature != 0)
          found[i].emplace_back(edgeKey(low, axis), signature);
      }
  });
  for (const std::size_t b : wanted_)
    for (std::size_t axis = 0; axis < 3; ++axis)
      blocks_[b].asked[axis] |= std::exchange(blocks_[b].wanted[axis], 0);
  for (std::size_t i = 0; i < wanted_.size(); ++i)
    for (const auto& [key, signature] : found[i]) {
      const LatticeIndex low = latticeIndexOf(key >> 2);
      const auto axis = static_cast<std::size_t>(key & 3);
      blocks_[wanted_[i]].crossed[axis] |= block::bit(block::slotOf(low));
      crossing_.emplace(key, signature);
      for (const LatticeIndex& corner : cube::kCorner) // the cells around the edge
        if ((axis == 0 ? corner.i : axis == 1 ? corner.j : corner.k) == 0) {
          const LatticeIndex cell = low - corner;
          const std::size_t b = makeBlock(block::blockOf(cell));
          blocks_[b].cells |= block::bit(block::slotOf(cell));
        }
    }
  wanted_.clear();
}

/// Whether some edge of a cell is crossed, of those looked at.
bool FaultedCells::isCrossed(const LatticeIndex& cell) const {
  const Index found = block_.find(latticeKey(block::blockOf(cell)));
  return found >= 0 && (blocks_[static_cast<std::size_t>(found)].cells & block::bit(block::slotOf(cell))) != 0;
}

std::array<std::uint64_t, 12> FaultedCells::crossings(const LatticeIndex& cell) const {
  std::array<std::uint64_t, 12> crossed{};
  const EdgeBlock* of = nullptr;
  for (std::size_t e = 0; e < 12; ++e) {
    const LatticeIndex low = cell + cube::kCorner[static_cast<std::size_t>(cube::kEdgeLow[e])];
    const auto axis = static_cast<std::size_t>(cube::kEdgeAxis[e]);
    if (of == nullptr || !(of->at == block::blockOf(low)))
      of = &blocks_[static_cast<std::size_t>(block_.find(latticeKey(block::blockOf(low))))];
    if ((of->crossed[axis] & block::bit(block::slotOf(low))) != 0)
      crossed[e] = crossing_.at(edgeKey(low, cube::kEdgeAxis[e]));
  }
  return crossed;
}

/// Only for cells with a crossed edge, all of whose edges have been looked at.
const FaultedCells::Division& FaultedCells::divisionOf(const LatticeIndex& cell, Known& known) const {
  const auto [entry, added] = known.divisions.try_emplace(latticeKey(cell));
  if (added) {
    entry->second.crossed = crossings(cell);
    entry->second.groups = cornerGroups(entry->second.crossed);
  }
  return entry->second;
}

/// True if what lies between the two sides ends in a cell around the vertex: some edge there is crossed and yet its ends are joined round the end.
bool FaultedCells::nearTip(const LatticeIndex& vertex, std::uint64_t signature, Known& known) const {
  const auto [entry, added] = known.near_tip.try_emplace(GhostKey{latticeKey(vertex), signature});
  if (added)
    entry->second = findTip(vertex, signature, known);
  return entry->second;
}

bool FaultedCells::findTip(const LatticeIndex& vertex, std::uint64_t signature, Known& known) const {
  for (const LatticeIndex& corner : cube::kCorner) {
    if (!isCrossed(vertex - corner)) {
      if (signature == 0)
        return true;
      continue;
    }
    const auto& [crossed, groups] = divisionOf(vertex - corner, known);
    for (std::size_t e = 0; e < 12; ++e)
      if (crossed[e] == signature &&
          groups[static_cast<std::size_t>(cube::kEdge[e][0])] == groups[static_cast<std::size_t>(cube::kEdge[e][1])])
        return true;
  }
  return false;
}

std::vector<std::vector<CellCopy>> FaultedCells::copies(const std::vector<LatticeIndex>& cells) {
  std::vector<std::vector<CellCopy>> result(cells.size());
  parallelBlocks(cells.size(), 256, threads_, [&](std::size_t begin, std::size_t end) {
    Known known;
    for (std::size_t i = begin; i < end; ++i)
      result[i] = copiesOf(cells[i], known);
  });
  for (std::vector<CellCopy>& of_cell : result)
    for (CellCopy& copy : of_cell)
      for (std::size_t c = 0; c < 8; ++c)
        if (copy.ghost[c] >= 0)
          copy.ghost[c] = ghostOf(copy.corner[c], copy.seen_from[c]);
  return result;
}

/// With ghosts not numbered yet, all 0.
std::vector<CellCopy> FaultedCells::copiesOf(const LatticeIndex& cell, Known& known) const {
  std::vector<CellCopy> result;
  if (!isCrossed(cell))
    return result;
  const auto& [crossed, groups] = divisionOf(cell, known);
  if (std::all_of(groups.begin(), groups.end(), [](int g) { return g == 0; }))
    return result;
  for (int group = 0; group < 8; ++group) {
    if (groups[static_cast<std::size_t>(group)] != group)
      continue;
    CellCopy copy;
    const LatticeIndex own = cell + cube::kCorner[static_cast<std::size_t>(group)];
    const auto between = signaturesFrom(group, groups, crossed);
    for (std::size_t c = 0; c < 8; ++c) {
      const LatticeIndex vertex = cell + cube::kCorner[c];
      const bool member = groups[c] == group;
      if (member)
        copy.home.push_back(lattice_.position(vertex));
      copy.corner[c] = vertex;
      if (member || nearTip(vertex, between[c], known))
        copy.ghost[c] = -1;
      else
        copy.seen_from[c] = seedOf(vertex, own, known);
    }
    result.push_back(std::move(copy));
  }
  return result;
}

LatticeIndex FaultedCells::seedOf(const LatticeIndex& ghost, const LatticeIndex& own, Known& known) const {
  VertexSets sets(ghost);
  std::uint64_t only = 0;
  bool several_faults = false;
  for (std::size_t c = 0; c < 8; ++c) {
    const LatticeIndex cell = ghost - cube::kCorner[c];
    if (!isCrossed(cell))
      continue;
    const auto& [crossed, groups] = divisionOf(cell, known);
    for (const std::uint64_t signature : crossed) {
      several_faults = several_faults || (signature != 0 && only != 0 && signature != only);
      only = signature != 0 ? signature : only;
    }
    for (std::size_t k = 0; k < 8; ++k)
      if (groups[k] != groups[c])
        sets.join(cell + cube::kCorner[k], cell + cube::kCorner[static_cast<std::size_t>(groups[k])]);
  }
  return several_faults ? sets.first(own) : sets.first();
}

Index FaultedCells::ghostOf(const LatticeIndex& vertex, const LatticeIndex& seed) {
  const auto [entry, added] = ghost_.try_emplace(GhostKey{latticeKey(vertex), latticeKey(seed)}, static_cast<Index>(ghosts_.size()));
  if (added)
    ghosts_.push_back({vertex, seed});
  return entry->second;
}

} // namespace graben
