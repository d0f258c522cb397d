#include "faulted_cells.h"

#include "local/box_around.h"

#include "graben/core/threads.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace graben {

namespace {

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

/// Whether both ends of an edge are in one group.
bool joined(const std::array<int, 8>& groups, std::size_t edge) {
  return groups[static_cast<std::size_t>(cube::kEdge[edge][0])] == groups[static_cast<std::size_t>(cube::kEdge[edge][1])];
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
    wantEdges(cell, cell + LatticeIndex{1, 1, 1});
  findWanted();

  // Whether a corner seen through a fault lies beside a tip depends on all cells around it.
  Known known;
  for (const LatticeIndex& cell : cells)
    if (isCrossed(cell, known)) {
      wantEdges(cell - LatticeIndex{1, 1, 1}, cell + LatticeIndex{2, 2, 2});
      known.block = nullptr; // blocks may have moved
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

/// Edges between lattice vertices of a box are to be looked at.
void FaultedCells::wantEdges(const LatticeIndex& low, const LatticeIndex& high) {
  const LatticeIndex first = block::blockOf(low);
  const LatticeIndex last = block::blockOf(high);
  for (int i = first.i; i <= last.i; ++i)
    for (int j = first.j; j <= last.j; ++j)
      for (int k = first.k; k <= last.k; ++k) {
        const std::size_t b = makeBlock({i, j, k});
        EdgeBlock& of = blocks_[b];
        const std::array<int, 3> from = {low.i - 4 * i, low.j - 4 * j, low.k - 4 * k};
        const std::array<int, 3> to = {high.i - 4 * i, high.j - 4 * j, high.k - 4 * k};
        const bool listed = (of.wanted[0] | of.wanted[1] | of.wanted[2]) != 0;
        for (std::size_t along = 0; along < 3; ++along) {
          BlockMask edges = ~of.asked[along];
          for (std::size_t axis = 0; axis < 3; ++axis)
            edges &= block::layers(axis, std::max(from[axis], 0), std::min(to[axis] - (axis == along ? 1 : 0), 3));
          of.wanted[along] |= edges;
        }
        if (!listed && (of.wanted[0] | of.wanted[1] | of.wanted[2]) != 0)
          wanted_.push_back(b);
      }
}

void FaultedCells::findWanted() {
  parallelFor(wanted_.size(), 8, threads_, [&](std::size_t i) { findSignatures(blocks_[wanted_[i]]); });
  for (const std::size_t b : wanted_)
    markCells(b);
  wanted_.clear();
}

/// Looks at the wanted edges of a block.
void FaultedCells::findSignatures(EdgeBlock& of) const {
  Bounds box;
  box.extend(lattice_.position(block::vertexOf(of.at, 0)));
  box.extend(lattice_.position(block::vertexOf(of.at, 0) + LatticeIndex{4, 4, 4}));
  // Grown, so that a fault that touches an edge on the box passes through the box.
  const LocalFaults faults(faults_, borders_, grown(box, 0.01 * lattice_.voxel_size));
  for (std::size_t axis = 0; axis < 3 && !faults.empty(); ++axis)
    for (BlockMask rest = of.wanted[axis]; rest != 0; rest &= rest - 1) {
      const LatticeIndex low = block::vertexOf(of.at, block::lowest(rest));
      const std::uint64_t signature = faults.signature(lattice_.position(low), lattice_.position(low + axisStep(static_cast<int>(axis))));
      if (signature == 0)
        continue;
      auto same = std::find_if(of.crossed.begin(), of.crossed.end(), [&](const CrossedEdges& c) { return c.signature == signature; });
      if (same == of.crossed.end())
        same = of.crossed.insert(same, {signature, {}});
      same->edges[axis] |= block::bit(block::lowest(rest));
    }
}

/// Marks the cells around the crossed edges of a block among those that were wanted, which now are asked for.
void FaultedCells::markCells(std::size_t block) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    EdgeBlock& of = blocks_[block];
    const LatticeIndex at = of.at;
    const BlockMask wanted = std::exchange(of.wanted[axis], 0);
    of.asked[axis] |= wanted;
    BlockMask crossed = 0;
    for (const CrossedEdges& c : of.crossed)
      crossed |= c.edges[axis] & wanted;
    const auto cells = block::cellsAround(crossed, axis);
    for (std::size_t f = 0; f < block::kForward; ++f)
      if (cells[f] != 0)
        blocks_[makeBlock(at - block::forward(f))].cells |= cells[f];
  }
}

const FaultedCells::EdgeBlock* FaultedCells::blockAt(const LatticeIndex& at, Known& known) const {
  if (known.block != nullptr && known.block->at == at)
    return known.block;
  const Index found = block_.find(latticeKey(at));
  if (found < 0)
    return nullptr;
  return known.block = &blocks_[static_cast<std::size_t>(found)];
}

/// Whether some edge of a cell is crossed, of those looked at.
bool FaultedCells::isCrossed(const LatticeIndex& cell, Known& known) const {
  const EdgeBlock* of = blockAt(block::blockOf(cell), known);
  return of != nullptr && (of->cells & block::bit(block::slotOf(cell))) != 0;
}

std::array<std::uint64_t, 12> FaultedCells::crossings(const LatticeIndex& cell, Known& known) const {
  std::array<std::uint64_t, 12> crossed{};
  for (std::size_t e = 0; e < 12; ++e) {
    const LatticeIndex low = cell + cube::kCorner[static_cast<std::size_t>(cube::kEdgeLow[e])];
    const auto axis = static_cast<std::size_t>(cube::kEdgeAxis[e]);
    for (const CrossedEdges& c : blockAt(block::blockOf(low), known)->crossed)
      if ((c.edges[axis] & block::bit(block::slotOf(low))) != 0)
        crossed[e] = c.signature;
  }
  return crossed;
}

/// Only for cells with a crossed edge, all of whose edges have been looked at.
const FaultedCells::Division& FaultedCells::divisionOf(const LatticeIndex& cell, Known& known) const {
  const auto [entry, added] = known.divisions.try_emplace(latticeKey(cell));
  if (added) {
    Division& division = entry->second;
    division.crossed = crossings(cell, known);
    division.groups = cornerGroups(division.crossed);
    for (std::size_t e = 0; e < 12; ++e)
      division.has_tip = division.has_tip || (division.crossed[e] != 0 && joined(division.groups, e));
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
    if (!isCrossed(vertex - corner, known)) {
      if (signature == 0)
        return true;
      continue;
    }
    const Division& division = divisionOf(vertex - corner, known);
    if (signature != 0 && !division.has_tip)
      continue;
    for (std::size_t e = 0; e < 12; ++e)
      if (division.crossed[e] == signature && joined(division.groups, e))
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
  if (!isCrossed(cell, known))
    return result;
  const auto& [crossed, groups, has_tip] = divisionOf(cell, known);
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
    if (!isCrossed(cell, known))
      continue;
    const auto& [crossed, groups, has_tip] = divisionOf(cell, known);
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
