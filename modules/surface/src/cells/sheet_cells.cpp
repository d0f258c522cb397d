#include "sheet_cells.h"

#include "occupied_cells.h"

#include "graben/core/threads.h"

#include <algorithm>
#include <cmath>

namespace graben {

namespace {

/// The surface in the whole cells of a block, and the cells through each of whose faces it passes on (see cube::kFace).
struct Passages {
  BlockMask surface = 0;
  std::array<BlockMask, 6> through{};
};

Passages passagesOf(const LatticeBlocks& blocks, std::size_t b, BlockMask cells) {
  BlockMask all_defined = cells;
  for (const BlockMask defined : blocks.atCorners(b, [&](std::size_t next, std::size_t) { return blocks[next].defined; }))
    all_defined &= defined;
  const std::array<BlockMask, 8> in = blocks.atCorners(b, [&](std::size_t next, std::size_t) { return blocks[next].inside; });
  const auto passes = [&in](const auto& corners) {
    BlockMask any = 0;
    BlockMask all = ~BlockMask(0);
    for (const int c : corners) {
      any |= in[static_cast<std::size_t>(c)];
      all &= in[static_cast<std::size_t>(c)];
    }
    return any & ~all;
  };
  Passages result;
  result.surface = all_defined & passes(std::array<int, 8>{0, 1, 2, 3, 4, 5, 6, 7});
  for (std::size_t face = 0; face < 6; ++face)
    result.through[face] = result.surface & passes(cube::kFace[face]);
  return result;
}

} // namespace

SheetCells::SheetCells(const SignedDistance& field, const ExtractionOptions& options)
  : field_(field), options_(options), lattice_(options.lattice), faulted_(field.faults(), field.borders(), options.lattice, options.threads) {}

void SheetCells::grow() {
  seed();
  double done = 0.0;
  while (!frontier_.empty()) {
    report(options_.progress, "marching cubes", done);
    done += 0.5 * (0.9 - done);
    addLevel();
    frontier_.clear();
    std::swap(frontier_, next_);
  }
  blocks_.link(options_.threads);
}

void SheetCells::seed() {
  const TangentPlanes& planes = field_.planes();
  const std::vector<Index>& picks = field_.grid().order();
  const auto place = [&](std::size_t i) {
    const auto p = static_cast<std::size_t>(picks[i]);
    // A lattice vertex on the surface counts as outside, so where the surface runs along the lattice it belongs to the cells behind it.
    return Vector3(planes.centres[p] + (options_.iso_level - 1e-6 * lattice_.voxel_size) * planes.normals[p]);
  };
  for (const KeyedMask& entry : occupiedCells(picks.size(), place, lattice_, options_.threads))
    frontier_.add(blocks_.make(latticeIndexOf(entry.key)), entry.mask);
}

void SheetCells::addLevel() {
  for (const Index b : frontier_.blocks)
    blocks_[static_cast<std::size_t>(b)].visited |= frontier_.of(b);
  std::vector<SheetCell> copies;
  findFaulted();
  std::vector<LatticeIndex> faulted;
  for (const Index b : frontier_.blocks)
    for (BlockMask rest = frontier_.of(b) & ~whole_.of(b); rest != 0; rest &= rest - 1)
      faulted.push_back(blocks_[static_cast<std::size_t>(b)].vertex(block::lowest(rest)));
  faulted_.findCrossings(faulted);
  std::vector<std::vector<CellCopy>> made = faulted_.copies(faulted);
  for (std::size_t i = 0; i < faulted.size(); ++i)
    addCopies(faulted[i], std::move(made[i]), copies);
  parallelFor(whole_.blocks.size(), 64, options_.threads, [&](std::size_t i) {
    const Index b = whole_.blocks[i];
    blocks_.findForward(static_cast<std::size_t>(b), block::cornersOf(whole_.of(b)));
  });
  for (const Index b : whole_.blocks) {
    const auto corners = block::cornersOf(whole_.of(b));
    for (std::size_t f = 0; f < block::kForward; ++f)
      if (corners[f] != 0)
        wanted_.add(blocks_.makeForward(static_cast<std::size_t>(b), f), corners[f]);
  }
  checkMemory();
  evaluate();
  evaluateGhosts();
  keepCrossed(copies);
  whole_.clear();
}

/// Divides the frontier in cells that no fault touches, which are whole, and the rest.
void SheetCells::findFaulted() {
  const FaultNetwork& faults = field_.faults();
  std::vector<BlockMask> untouched(frontier_.blocks.size());
  parallelFor(untouched.size(), 64, options_.threads, [&](std::size_t i) {
    const BlockMask cells = untouched[i] = frontier_.of(frontier_.blocks[i]);
    const LatticeBlock& of = blocks_[static_cast<std::size_t>(frontier_.blocks[i])];
    const auto touched = [&](const LatticeIndex& low, int cells_across) {
      Bounds box;
      box.extend(lattice_.position(low));
      box.extend(lattice_.position(low + LatticeIndex{cells_across, cells_across, cells_across}));
      return faults.mayTouch(box);
    };
    if (faults.empty() || !touched(of.vertex(0), 4))
      return;
    for (BlockMask rest = cells; rest != 0; rest &= rest - 1)
      if (touched(of.vertex(block::lowest(rest)), 1))
        untouched[i] &= ~(rest & (~rest + 1));
  });
  for (std::size_t i = 0; i < untouched.size(); ++i)
    whole_.add(frontier_.blocks[i], untouched[i]);
}

void SheetCells::addCopies(const LatticeIndex& cell, std::vector<CellCopy> made, std::vector<SheetCell>& copies) {
  if (made.empty())
    whole_.add(blocks_.find(block::blockOf(cell)), block::bit(block::slotOf(cell)));
  for (CellCopy& copy : made) {
    SheetCell sheet;
    sheet.at = cell;
    sheet.home = static_cast<Index>(homes_.size());
    for (std::size_t c = 0; c < 8; ++c)
      sheet.node[c] = copy.ghost[c] < 0 ? realNode(copy.corner[c]) : -1 - copy.ghost[c];
    homes_.push_back(std::move(copy.home));
    copies.push_back(sheet);
  }
}

Index SheetCells::realNode(const LatticeIndex& vertex) {
  const Index b = blocks_.make(block::blockOf(vertex));
  const int slot = block::slotOf(vertex);
  wanted_.add(b, block::bit(slot));
  return block::kSlots * b + slot;
}

void SheetCells::evaluate() {
  parallelBlocks(wanted_.blocks.size(), 8, options_.threads, [&](std::size_t begin, std::size_t end) {
    SignedDistance::Scratch scratch;
    Points places;
    std::vector<FieldValue> values;
    for (std::size_t i = begin; i < end; ++i) {
      const auto b = static_cast<std::size_t>(wanted_.blocks[i]);
      LatticeBlock& of = blocks_[b];
      LatticeValues& known = blocks_.values(b);
      const BlockMask wanted = wanted_.of(wanted_.blocks[i]) & ~of.asked;
      if (wanted == 0)
        continue;
      places.clear();
      for (BlockMask rest = wanted; rest != 0; rest &= rest - 1)
        places.push_back(lattice_.position(of.vertex(block::lowest(rest))));
      field_.at(places, places, scratch, values);
      if (of.asked == 0)
        known.meets.fill(0);
      std::size_t found = 0;
      for (BlockMask rest = wanted; rest != 0; rest &= rest - 1, ++found)
        keep(values[found], places[found], block::lowest(rest), of, known);
      of.asked |= wanted;
    }
  });
  wanted_.clear();
}

void SheetCells::keep(const FieldValue& found, const Vector3& place, int slot, LatticeBlock& of, LatticeValues& known) const {
  const double value = found.value - options_.iso_level;
  known.value[static_cast<std::size_t>(slot)] = value;
  known.plane[static_cast<std::size_t>(slot)] = found.plane;
  if (!found.defined())
    return;
  of.defined |= block::bit(slot);
  of.inside |= value < 0.0 ? block::bit(slot) : 0;
  const auto p = static_cast<std::size_t>(found.plane);
  const Vector3 half = 0.5 * lattice_.voxel_size * field_.planes().normals[p];
  const double distance = (place - field_.planes().centres[p]).dot(field_.planes().normals[p]) - options_.iso_level;
  const double reach = half.cwiseAbs().sum();
  for (std::size_t c = 0; c < 8; ++c) {
    const LatticeIndex& corner = cube::kCorner[c];
    const double at_middle = distance + (corner.i != 0 ? -half.x() : half.x()) + (corner.j != 0 ? -half.y() : half.y()) +
                             (corner.k != 0 ? -half.z() : half.z());
    known.meets[c] |= std::abs(at_middle) <= reach ? block::bit(slot) : 0;
  }
}

void SheetCells::evaluateGhosts() {
  constexpr std::size_t grain = 8;
  const std::vector<GhostVertex>& ghosts = faulted_.ghosts();
  std::vector<std::pair<std::uint64_t, std::size_t>> order; // block, ghost
  for (std::size_t g = ghost_values_.size(); g < ghosts.size(); ++g)
    order.emplace_back(latticeKey(block::blockOf(ghosts[g].at)), g);
  std::sort(order.begin(), order.end());
  std::vector<std::size_t> first; // of each block in that order
  for (std::size_t i = 0; i < order.size(); ++i)
    if (i == 0 || order[i].first != order[i - 1].first)
      first.push_back(i);
  first.push_back(order.size());
  ghost_values_.resize(ghosts.size());
  parallelBlocks(first.size() - 1, grain, options_.threads, [&](std::size_t begin, std::size_t end) {
    SignedDistance::Scratch scratch;
    Points places;
    Points viewpoints;
    std::vector<FieldValue> values;
    for (std::size_t b = begin; b < end; ++b) {
      places.clear();
      viewpoints.clear();
      for (std::size_t i = first[b]; i < first[b + 1]; ++i) {
        const GhostVertex& ghost = ghosts[order[i].second];
        places.push_back(lattice_.position(ghost.at));
        viewpoints.push_back(lattice_.position(ghost.seen_from));
      }
      field_.at(places, viewpoints, scratch, values);
      for (std::size_t i = first[b]; i < first[b + 1]; ++i) {
        FieldValue& value = ghost_values_[order[i].second];
        value = values[i - first[b]];
        value.value -= options_.iso_level;
      }
    }
  });
}

/// Keeps the cells the surface passes through, and goes on to the cells beside them that it passes into.
void SheetCells::keepCrossed(const std::vector<SheetCell>& copies) {
  std::vector<Passages> passages(whole_.blocks.size());
  parallelFor(passages.size(), 256, options_.threads,
              [&](std::size_t i) { passages[i] = passagesOf(blocks_, static_cast<std::size_t>(whole_.blocks[i]), whole_.of(whole_.blocks[i])); });
  for (std::size_t i = 0; i < passages.size(); ++i) {
    const Index b = whole_.blocks[i];
    blocks_[static_cast<std::size_t>(b)].surface |= passages[i].surface;
    for (std::size_t face = 0; face < 6; ++face) {
      const std::size_t axis = face / 2;
      const bool up = face % 2 == 1;
      const BlockMask from = passages[i].through[face];
      const BlockMask leaving = from & (up ? block::kLast[axis] : block::kFirst[axis]);
      const BlockMask staying = from & ~leaving;
      const LatticeBlock& own = blocks_[static_cast<std::size_t>(b)];
      next_.add(b, (up ? staying << block::kShift[axis] : staying >> block::kShift[axis]) & ~own.visited);
      if (leaving == 0)
        continue;
      const Index beside = up ? blocks_.makeForward(static_cast<std::size_t>(b), std::size_t(4) >> axis)
                              : blocks_.make(own.at + cube::kFaceNeighbor[face]);
      next_.add(beside, (up ? leaving >> (3 * block::kShift[axis]) : leaving << (3 * block::kShift[axis])) &
                          ~blocks_[static_cast<std::size_t>(beside)].visited);
    }
  }
  for (const SheetCell& copy : copies) {
    const auto passes = [&](const auto& corners) {
      int inside = 0;
      for (const int c : corners)
        inside += value(copy.node[static_cast<std::size_t>(c)]) < 0.0 ? 1 : 0;
      return inside != 0 && inside != static_cast<int>(corners.size());
    };
    const bool defined = std::all_of(copy.node.begin(), copy.node.end(), [this](Index n) { return value(n) == value(n); });
    if (!defined || !passes(std::array<int, 8>{0, 1, 2, 3, 4, 5, 6, 7}))
      continue;
    copies_.push_back(copy);
    for (std::size_t face = 0; face < 6; ++face) {
      const LatticeIndex beside = copy.at + cube::kFaceNeighbor[face];
      if (!passes(cube::kFace[face]))
        continue;
      const Index b = blocks_.make(block::blockOf(beside));
      next_.add(b, block::bit(block::slotOf(beside)) & ~blocks_[static_cast<std::size_t>(b)].visited);
    }
  }
}

void SheetCells::checkMemory() const {
  const std::size_t bytes = blocks_.size() * kBytesOfBlock + ghosts().size() * 200;
  if (options_.memory_limit > 0 && bytes > options_.memory_limit)
    refuseVoxelSize(lattice_.voxel_size, 4.0 * static_cast<double>(bytes) / static_cast<double>(options_.memory_limit), 0.0); // and growing
}

} // namespace graben
