#include "sheet_edges.h"

#include "graben/core/sort_unique.h"
#include "graben/core/threads.h"

#include <algorithm>

namespace graben {

namespace {

constexpr std::size_t kGrain = 64;
constexpr std::array<LatticeIndex, 3> kStep = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

/// The block one step along an axis, as a forward block.
constexpr std::size_t along(std::size_t axis) { return std::size_t(4) >> axis; }

} // namespace

struct SheetEdges::Mean {
  Vector3 sum = Vector3::Zero();
  double weight = 0.0;
  void add(const Vector3& place, double by) {
    sum += by * place;
    weight += by;
  }
};

SheetEdges::SheetEdges(const SheetCells& cells, const ExtractionOptions& options)
  : cells_(cells), options_(options), blocks_(cells.blocks().size()), ghost_snapped_(cells.ghosts().size(), 0) {
  findEdges();
  findGhostEdges();
  if (options_.snap > 0.0) {
    findSnapped();
    drawEdges();
    drawGhostEdges();
  }
  number();
  numberGhosts();
}

void SheetEdges::findEdges() {
  const LatticeBlocks& lattice = cells_.blocks();
  parallelFor(blocks_.size(), kGrain, options_.threads, [&](std::size_t b) {
    const LatticeBlock& of = lattice[b];
    std::array<BlockMask, block::kForward> surface{};
    for (std::size_t f = 0; f < block::kForward; ++f)
      surface[f] = of.back[f] < 0 ? 0 : lattice[static_cast<std::size_t>(of.back[f])].surface;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      BlockMask used = 0;
      for (const LatticeIndex& c : cube::kCorner)
        if ((axis == 0 ? c.i : axis == 1 ? c.j : c.k) == 0)
          used |= block::cellWithCorner(surface, c);
      const Index next = of.forward[along(axis)];
      const BlockMask high = block::pull(of.inside, next < 0 ? 0 : lattice[static_cast<std::size_t>(next)].inside, axis);
      blocks_[b].edge[axis] = used & (of.inside ^ high);
    }
  });
}

void SheetEdges::findGhostEdges() {
  std::vector<NodeEdge> found;
  for (const SheetCell& cell : cells_.copies()) {
    for (std::size_t e = 0; e < 12; ++e) {
      const NodeEdge ends = endsOf(cell.node, e);
      if (inside(ends.low) == inside(ends.high))
        continue;
      if (ends.low < 0 || ends.high < 0)
        found.push_back(ends);
      else
        blocks_[static_cast<std::size_t>(ends.low / block::kSlots)].edge[static_cast<std::size_t>(cube::kEdgeAxis[e])] |=
          block::bit(ends.low % block::kSlots);
    }
  }
  sortUnique(found);
  for (const NodeEdge& ends : found)
    ghost_edges_.push_back({ends, kNone, -1});
}

double SheetEdges::parameterOn(const NodeEdge& edge) const {
  const double low = cells_.value(edge.low);
  return low / (low - cells_.value(edge.high));
}

Vector3 SheetEdges::placeOn(const NodeEdge& edge) const {
  // Kept off the lattice vertices, so that no triangle loses its area.
  const double t = std::clamp(parameterOn(edge), 0.005, 0.995);
  const Vector3 a = options_.lattice.position(cells_.place(edge.low));
  return a + t * (options_.lattice.position(cells_.place(edge.high)) - a);
}

/// The lattice vertex one step along an axis, which must be in a block that exists.
Index SheetEdges::beside(Index node, std::size_t axis, bool up) const {
  const int slot = node % block::kSlots;
  const LatticeBlock& of = cells_.blocks()[static_cast<std::size_t>(node / block::kSlots)];
  if (up)
    return (block::bit(slot) & block::kLast[axis]) == 0 ? node + block::kShift[axis]
                                                        : block::kSlots * of.forward[along(axis)] + slot - 3 * block::kShift[axis];
  return (block::bit(slot) & block::kFirst[axis]) == 0 ? node - block::kShift[axis]
                                                       : block::kSlots * of.back[along(axis)] + slot + 3 * block::kShift[axis];
}

/// For each axis the lattice vertices that are the high end of one of the given edges.
std::array<BlockMask, 3> SheetEdges::behind(std::size_t b, std::array<BlockMask, 3> Block::*edges) const {
  std::array<BlockMask, 3> result{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Index back = cells_.blocks()[b].back[along(axis)];
    result[axis] = block::push((blocks_[b].*edges)[axis], back < 0 ? 0 : (blocks_[static_cast<std::size_t>(back)].*edges)[axis], axis);
  }
  return result;
}

/// Nodes that have the surface within options_.snap of an edge's length on one of their edges.
void SheetEdges::findSnapped() {
  parallelFor(blocks_.size(), kGrain, options_.threads, [&](std::size_t b) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (BlockMask rest = blocks_[b].edge[axis]; rest != 0; rest &= rest - 1) {
        const int slot = block::lowest(rest);
        const Index low = block::kSlots * static_cast<Index>(b) + slot;
        const double t = parameterOn({low, beside(low, axis, true)});
        blocks_[b].near_low[axis] |= t < options_.snap ? block::bit(slot) : 0;
        blocks_[b].near_high[axis] |= t > 1.0 - options_.snap ? block::bit(slot) : 0;
      }
  });
  parallelFor(blocks_.size(), kGrain, options_.threads, [&](std::size_t b) {
    const auto high = behind(b, &Block::near_high);
    for (std::size_t axis = 0; axis < 3; ++axis)
      blocks_[b].snapped |= blocks_[b].near_low[axis] | high[axis];
  });
  const auto mark = [this](Index node) {
    if (node < 0)
      ghost_snapped_[static_cast<std::size_t>(-1 - node)] = 1;
    else
      blocks_[static_cast<std::size_t>(node / block::kSlots)].snapped |= block::bit(node % block::kSlots);
  };
  for (const GhostEdge& edge : ghost_edges_) {
    const double t = parameterOn(edge.ends);
    if (t < options_.snap)
      mark(edge.ends.low);
    if (t > 1.0 - options_.snap)
      mark(edge.ends.high);
  }
}

bool SheetEdges::snapped(Index node) const {
  return node < 0 ? ghost_snapped_[static_cast<std::size_t>(-1 - node)] != 0
                  : (blocks_[static_cast<std::size_t>(node / block::kSlots)].snapped & block::bit(node % block::kSlots)) != 0;
}

/// An edge between two snapped ends goes to the outer one, so that no triangle is left between them.
void SheetEdges::drawEdges() {
  const LatticeBlocks& lattice = cells_.blocks();
  parallelFor(blocks_.size(), kGrain, options_.threads, [&](std::size_t b) {
    Block& own = blocks_[b];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Index next = lattice[b].forward[along(axis)];
      const BlockMask high = block::pull(own.snapped, next < 0 ? 0 : blocks_[static_cast<std::size_t>(next)].snapped, axis);
      own.to_low[axis] = own.edge[axis] & own.snapped & (~lattice[b].inside | ~high);
      own.to_high[axis] = own.edge[axis] & high & ~own.to_low[axis];
    }
  });
  parallelFor(blocks_.size(), kGrain, options_.threads, [&](std::size_t b) {
    const auto high = behind(b, &Block::to_high);
    for (std::size_t axis = 0; axis < 3; ++axis)
      blocks_[b].group |= blocks_[b].to_low[axis] | high[axis];
  });
}

void SheetEdges::drawGhostEdges() {
  for (std::size_t g = 0; g < ghost_edges_.size(); ++g) {
    GhostEdge& edge = ghost_edges_[g];
    const bool low_inside = inside(edge.ends.low);
    const Index outer = low_inside ? edge.ends.high : edge.ends.low;
    const Index inner = low_inside ? edge.ends.low : edge.ends.high;
    edge.target = snapped(outer) ? outer : snapped(inner) ? inner : kNone;
    if (edge.target < 0)
      continue;
    blocks_[static_cast<std::size_t>(edge.target / block::kSlots)].group |= block::bit(edge.target % block::kSlots);
    drawn_.push_back(g);
  }
  std::stable_sort(drawn_.begin(), drawn_.end(), [this](std::size_t a, std::size_t b) { return ghost_edges_[a].target < ghost_edges_[b].target; });
}

void SheetEdges::number() {
  for (Block& b : blocks_) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      b.first[axis] = count_;
      count_ += block::count(b.single(axis));
    }
    b.first[3] = count_;
    count_ += block::count(b.group);
  }
  lattice_vertices_ = count_;
}

void SheetEdges::numberGhosts() {
  std::vector<Index> group(ghost_snapped_.size(), -1);
  for (GhostEdge& edge : ghost_edges_) {
    if (edge.target == kNone) {
      edge.vertex = count_++;
    } else if (edge.target < 0) {
      Index& shared = group[static_cast<std::size_t>(-1 - edge.target)];
      if (shared < 0)
        shared = count_++;
      edge.vertex = shared;
    }
  }
}

Index SheetEdges::groupVertex(Index node) const {
  const Block& b = blocks_[static_cast<std::size_t>(node / block::kSlots)];
  return b.first[3] + block::rank(b.group, node % block::kSlots);
}

Index SheetEdges::vertexOn(const NodeEdge& edge, int axis) const {
  if (edge.low < 0 || edge.high < 0) {
    const auto found = std::lower_bound(ghost_edges_.begin(), ghost_edges_.end(), edge,
                                        [](const GhostEdge& g, const NodeEdge& ends) { return g.ends < ends; });
    return found->target >= 0 ? groupVertex(found->target) : found->vertex;
  }
  const Block& b = blocks_[static_cast<std::size_t>(edge.low / block::kSlots)];
  const int slot = edge.low % block::kSlots;
  const auto a = static_cast<std::size_t>(axis);
  if ((b.to_low[a] & block::bit(slot)) != 0)
    return groupVertex(edge.low);
  if ((b.to_high[a] & block::bit(slot)) != 0)
    return groupVertex(edge.high);
  return b.first[a] + block::rank(b.single(a), slot);
}

void SheetEdges::addTo(Mean& mean, const NodeEdge& edge, Index node) const {
  const double t = parameterOn(edge);
  mean.add(placeOn(edge), (node == edge.low ? t : 1.0 - t) <= options_.snap ? 1000.0 : 1.0);
}

Vector3 SheetEdges::groupPlace(Index node) const {
  const auto b = static_cast<std::size_t>(node / block::kSlots);
  const BlockMask here = block::bit(node % block::kSlots);
  const auto high = behind(b, &Block::to_high);
  Mean mean;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if ((blocks_[b].to_low[axis] & here) != 0)
      addTo(mean, {node, beside(node, axis, true)}, node);
    if ((high[axis] & here) != 0)
      addTo(mean, {beside(node, axis, false), node}, node);
  }
  auto drawn = std::lower_bound(drawn_.begin(), drawn_.end(), node, [this](std::size_t g, Index n) { return ghost_edges_[g].target < n; });
  for (; drawn != drawn_.end() && ghost_edges_[*drawn].target == node; ++drawn)
    addTo(mean, ghost_edges_[*drawn].ends, node);
  return mean.sum / mean.weight;
}

void SheetEdges::placeBlock(std::size_t b, Points& places) const {
  auto vertex = static_cast<std::size_t>(blocks_[b].first[0]);
  const Index first = block::kSlots * static_cast<Index>(b);
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (BlockMask rest = blocks_[b].single(axis); rest != 0; rest &= rest - 1) {
      const Index low = first + block::lowest(rest);
      places[vertex++] = placeOn({low, beside(low, axis, true)});
    }
  for (BlockMask rest = blocks_[b].group; rest != 0; rest &= rest - 1)
    places[vertex++] = groupPlace(first + block::lowest(rest));
}

Points SheetEdges::places() const {
  Points places;
  places.reserve(withRoom(static_cast<std::size_t>(count_)));
  places.resize(static_cast<std::size_t>(count_));
  parallelFor(blocks_.size(), kGrain, options_.threads, [&](std::size_t b) { placeBlock(b, places); });
  std::vector<Mean> means(static_cast<std::size_t>(count_ - lattice_vertices_));
  for (const GhostEdge& edge : ghost_edges_) {
    if (edge.target >= 0)
      continue;
    Mean& mean = means[static_cast<std::size_t>(edge.vertex - lattice_vertices_)];
    if (edge.target == kNone)
      mean.add(placeOn(edge.ends), 1.0);
    else
      addTo(mean, edge.ends, edge.target);
  }
  for (std::size_t v = 0; v < means.size(); ++v)
    places[static_cast<std::size_t>(lattice_vertices_) + v] = means[v].sum / means[v].weight;
  return places;
}

} // namespace graben
