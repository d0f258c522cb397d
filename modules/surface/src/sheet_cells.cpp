#include "sheet_cells.h"

#include "graben/core/errors.h"
#include "graben/core/threads.h"

#include <algorithm>
#include <numeric>

namespace graben {

namespace {

std::uint64_t edgeKey(const LatticeIndex& low, int axis) {
  return (latticeKey(low) << 2) | static_cast<std::uint64_t>(axis);
}

LatticeIndex axisStep(int axis) { return {axis == 0 ? 1 : 0, axis == 1 ? 1 : 0, axis == 2 ? 1 : 0}; }

LatticeIndex indexOf(std::uint64_t key) {
  constexpr std::uint64_t mask = (1u << 20) - 1;
  constexpr std::int32_t offset = 1 << 19;
  return {static_cast<std::int32_t>((key >> 40) & mask) - offset, static_cast<std::int32_t>((key >> 20) & mask) - offset,
          static_cast<std::int32_t>(key & mask) - offset};
}

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

SheetCells::SheetCells(const SignedDistance& field, const ExtractionOptions& options)
  : field_(field), options_(options), lattice_(options.lattice) {}

void SheetCells::grow() {
  Frontier frontier = seeds();
  double done = 0.0;
  while (!frontier.empty()) {
    report(options_.progress, "marching cubes", done);
    done += 0.5 * (0.9 - done);
    const std::size_t first = cells_.size();
    growLevel(frontier);
    checkMemory();
    frontier = nextFrontier(first);
  }
}

void SheetCells::checkMemory() const {
  if (options_.memory_limit == 0)
    return;
  const std::size_t bytes = nodes_.size() * (sizeof(SheetNode) + 20) + cells_.size() * (sizeof(SheetCell) + 120);
  if (bytes <= options_.memory_limit)
    return;
  const double factor = 1.2 * std::sqrt(static_cast<double>(bytes) / static_cast<double>(options_.memory_limit));
  throw ResourceError("marching cubes", "the surface at voxel size " + std::to_string(lattice_.voxel_size) +
                                          " does not fit into memory; a voxel size of " +
                                          std::to_string(lattice_.voxel_size * std::max(2.0, factor)) + " would");
}

SheetCells::Frontier SheetCells::seeds() const {
  const Points& centres = field_.planes().centres;
  std::vector<std::uint64_t> keys;
  keys.reserve(centres.size());
  const double limit = kLatticeLimit * lattice_.voxel_size;
  for (std::size_t p = 0; p < centres.size(); ++p) {
    // A lattice vertex on the surface counts as outside, so where the surface runs along the lattice it belongs to the cells behind it.
    const Vector3 centre = centres[p] + (options_.iso_level - 1e-6 * lattice_.voxel_size) * field_.planes().normals[p];
    if (!centre.allFinite())
      continue;
    if ((centre - lattice_.origin).cwiseAbs().maxCoeff() > limit)
      throw ResourceError("marching cubes", "the data are more than " + std::to_string(kLatticeLimit) +
                                              " voxels across; use a larger voxel size or remove far outliers");
    keys.push_back(latticeKey(lattice_.cellOf(centre)));
  }
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  Frontier frontier(keys.size());
  std::transform(keys.begin(), keys.end(), frontier.begin(), indexOf);
  return frontier;
}

void SheetCells::growLevel(const Frontier& frontier) {
  const FaultNetwork& faults = field_.faults();
  std::vector<std::uint8_t> touched(frontier.size(), 0);
  if (!faults.empty())
    parallelFor(frontier.size(), 1024, options_.threads, [&](std::size_t c) {
      Bounds box;
      box.extend(lattice_.position(frontier[c]));
      box.extend(lattice_.position(frontier[c] + LatticeIndex{1, 1, 1}));
      touched[c] = faults.mayTouch(box) ? 1 : 0;
    });
  Frontier faulted;
  for (std::size_t c = 0; c < frontier.size(); ++c) {
    visited_[frontier[c]] = 1;
    if (touched[c] != 0)
      faulted.push_back(frontier[c]);
  }
  findCrossings(faulted);

  candidates_.clear();
  for (std::size_t c = 0; c < frontier.size(); ++c) {
    if (touched[c] != 0)
      addCopies(frontier[c]);
    else
      addWholeCell(frontier[c]);
  }
  evaluatePending();
  const double iso = options_.iso_level;
  for (const SheetCell& cell : candidates_) {
    int inside = 0;
    bool defined = true;
    for (const Index n : cell.node) {
      const FieldValue& field = nodes_[static_cast<std::size_t>(n)].field;
      defined = defined && field.defined();
      inside += field.value < iso ? 1 : 0;
    }
    if (defined && inside != 0 && inside != 8)
      cells_.push_back(cell);
  }
}

SheetCells::Frontier SheetCells::nextFrontier(std::size_t first_cell) {
  const double iso = options_.iso_level;
  std::vector<std::uint64_t> keys;
  for (std::size_t c = first_cell; c < cells_.size(); ++c) {
    const SheetCell& cell = cells_[c];
    for (std::size_t f = 0; f < 6; ++f) {
      int inside = 0;
      for (const int corner : cube::kFace[f])
        inside += nodes_[static_cast<std::size_t>(cell.node[static_cast<std::size_t>(corner)])].field.value < iso ? 1 : 0;
      const LatticeIndex neighbor = cell.at + cube::kFaceNeighbor[f];
      if (inside == 0 || inside == 4)
        continue;
      std::uint8_t& visited = visited_[neighbor];
      if (visited == 0) {
        visited = 1;
        keys.push_back(latticeKey(neighbor));
      }
    }
  }
  std::sort(keys.begin(), keys.end());
  Frontier frontier(keys.size());
  std::transform(keys.begin(), keys.end(), frontier.begin(), indexOf);
  return frontier;
}

void SheetCells::findCrossings(const Frontier& faulted) {
  std::vector<EdgeKey> keys;
  for (const LatticeIndex& cell : faulted)
    for (std::size_t e = 0; e < 12; ++e)
      keys.push_back(edgeKey(cell + cube::kCorner[static_cast<std::size_t>(cube::kEdgeLow[e])], cube::kEdgeAxis[e]));
  fillCrossings(keys);

  // Whether a corner seen through a fault lies beside a tip depends on all cells around it.
  keys.clear();
  for (const LatticeIndex& cell : faulted) {
    const auto crossed = crossings(cell);
    if (std::all_of(crossed.begin(), crossed.end(), [](std::uint64_t s) { return s == 0; }))
      continue;
    for (int i = -1; i <= 2; ++i)
      for (int j = -1; j <= 2; ++j)
        for (int k = -1; k <= 2; ++k)
          for (int axis = 0; axis < 3; ++axis)
            if ((axis == 0 ? i : axis == 1 ? j : k) < 2)
              keys.push_back(edgeKey(cell + LatticeIndex{i, j, k}, axis));
  }
  fillCrossings(keys);
}

void SheetCells::fillCrossings(std::vector<EdgeKey>& keys) {
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  keys.erase(std::remove_if(keys.begin(), keys.end(), [this](EdgeKey k) { return crossing_.count(k) != 0; }), keys.end());
  std::vector<std::uint64_t> signature(keys.size());
  parallelFor(keys.size(), 256, options_.threads, [&](std::size_t i) {
    const LatticeIndex low = indexOf(keys[i] >> 2);
    const LatticeIndex high = low + axisStep(static_cast<int>(keys[i] & 3));
    signature[i] = faultSignature(field_.faults(), lattice_.position(low), lattice_.position(high));
  });
  for (std::size_t i = 0; i < keys.size(); ++i)
    crossing_.emplace(keys[i], signature[i]);
}

std::array<std::uint64_t, 12> SheetCells::crossings(const LatticeIndex& cell) const {
  std::array<std::uint64_t, 12> crossed{};
  for (std::size_t e = 0; e < 12; ++e) {
    const LatticeIndex low = cell + cube::kCorner[static_cast<std::size_t>(cube::kEdgeLow[e])];
    const auto found = crossing_.find(edgeKey(low, cube::kEdgeAxis[e]));
    crossed[e] = found == crossing_.end() ? 0 : found->second;
  }
  return crossed;
}

/// True if what lies between the two sides ends in a cell around the vertex: some edge there is crossed and yet its ends are joined round the end.
bool SheetCells::nearTip(const LatticeIndex& vertex, std::uint64_t signature) const {
  for (const LatticeIndex& corner : cube::kCorner) {
    const auto crossed = crossings(vertex - corner);
    const auto groups = cornerGroups(crossed);
    for (std::size_t e = 0; e < 12; ++e)
      if (crossed[e] == signature &&
          groups[static_cast<std::size_t>(cube::kEdge[e][0])] == groups[static_cast<std::size_t>(cube::kEdge[e][1])])
        return true;
  }
  return false;
}

void SheetCells::addWholeCell(const LatticeIndex& cell) {
  SheetCell whole;
  whole.at = cell;
  for (std::size_t c = 0; c < 8; ++c)
    whole.node[c] = realNode(cell + cube::kCorner[c]);
  candidates_.push_back(whole);
}

void SheetCells::addCopies(const LatticeIndex& cell) {
  const auto crossed = crossings(cell);
  const auto groups = cornerGroups(crossed);
  if (std::all_of(groups.begin(), groups.end(), [](int g) { return g == 0; })) {
    addWholeCell(cell);
    return;
  }
  for (int group = 0; group < 8; ++group) {
    if (groups[static_cast<std::size_t>(group)] != group)
      continue;
    SheetCell copy;
    copy.at = cell;
    copy.home = static_cast<Index>(homes_.size());
    const LatticeIndex own = cell + cube::kCorner[static_cast<std::size_t>(group)];
    const auto between = signaturesFrom(group, groups, crossed);
    Points home;
    for (std::size_t c = 0; c < 8; ++c) {
      const LatticeIndex vertex = cell + cube::kCorner[c];
      const bool member = groups[c] == group;
      if (member)
        home.push_back(lattice_.position(vertex));
      copy.node[c] = member || nearTip(vertex, between[c]) ? realNode(vertex) : ghostNode(vertex, own);
    }
    homes_.push_back(std::move(home));
    candidates_.push_back(copy);
  }
}

Index SheetCells::realNode(const LatticeIndex& vertex) {
  Index& node = real_node_[vertex];
  if (node < 0) {
    node = static_cast<Index>(nodes_.size());
    nodes_.push_back({vertex, vertex, {}});
  }
  return node;
}

LatticeIndex SheetCells::seedOf(const LatticeIndex& ghost, const LatticeIndex& own) const {
  VertexSets sets(ghost);
  std::uint64_t only = 0;
  bool several_faults = false;
  for (std::size_t c = 0; c < 8; ++c) {
    const LatticeIndex cell = ghost - cube::kCorner[c];
    const auto crossed = crossings(cell);
    const auto groups = cornerGroups(crossed);
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

Index SheetCells::ghostNode(const LatticeIndex& vertex, const LatticeIndex& own) {
  const LatticeIndex seed = seedOf(vertex, own);
  const auto [entry, added] =
    ghost_node_.try_emplace(GhostKey{latticeKey(vertex), latticeKey(seed)}, static_cast<Index>(nodes_.size()));
  if (added)
    nodes_.push_back({vertex, seed, {}});
  return entry->second;
}

void SheetCells::evaluatePending() {
  const std::size_t first = evaluated_;
  parallelBlocks(nodes_.size() - first, 256, options_.threads, [&](std::size_t begin, std::size_t end) {
    SignedDistance::Scratch scratch;
    for (std::size_t n = first + begin; n < first + end; ++n)
      nodes_[n].field = field_.at(lattice_.position(nodes_[n].at), lattice_.position(nodes_[n].seen_from), scratch);
  });
  evaluated_ = nodes_.size();
}

} // namespace graben
