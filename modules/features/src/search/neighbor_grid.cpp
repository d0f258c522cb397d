#include "graben/features/neighbor_grid.h"

#include "search/neighbor_grid_data.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace graben {
namespace {

using detail::Block;
using detail::closer;
using detail::NeighborGridData;
using detail::Superblock;

const Points NO_POINTS;
constexpr std::size_t MAX_BLOCKS = 64; // visited by one query; beyond, the tree is faster
constexpr std::size_t MANY = 4096, POINTS_A_BLOCK = 16; // points that a query may look at, and for how many of them it may visit one block more

/// Cells that a cube around a query, or a box with a margin, overlaps.
struct CellRange {
  std::array<std::int64_t, 3> low, high;

  CellRange(const detail::CellLattice& lattice, const Vector3& query, double half_edge)
      : CellRange(lattice, Bounds{query, query}, half_edge) {}

  CellRange(const detail::CellLattice& lattice, const Bounds& box, double margin) {
    for (int axis = 0; axis < 3; ++axis) {
      // Rounding must not shut out a point that lies on the cube.
      const double reach = margin * (1.0 + 1e-12) + 1e-15 * std::max(std::abs(box.low[axis]), std::abs(box.high[axis]));
      low[static_cast<std::size_t>(axis)] = lattice.cell(box.low[axis] - reach, axis);
      high[static_cast<std::size_t>(axis)] = lattice.cell(box.high[axis] + reach, axis);
    }
  }
  std::size_t blocks() const { return count(2); }
  std::size_t superblocks() const { return count(4); }

private:
  /// Of cubes with an edge of 2^bits cells; no more than that of many along an axis.
  std::size_t count(unsigned bits) const {
    constexpr std::int64_t MANY_ALONG = 1 << 20;
    std::int64_t count = 1;
    for (std::size_t axis = 0; axis < 3; ++axis)
      count *= std::min((high[axis] >> bits) - (low[axis] >> bits) + 1, MANY_ALONG);
    return static_cast<std::size_t>(count);
  }
};

/// Where a cell of 4 x 4 x 4 in their order is along an axis, 0 to 3.
unsigned positionAlong(unsigned axis, unsigned cell) {
  return (cell >> axis & 1U) | (cell >> (axis + 2) & 2U);
}

/// For each axis and range of the 4 cells along it, the cells of a block within.
struct BlockMasks {
  std::uint64_t of[3][4][4] = {};
  BlockMasks() {
    for (unsigned cell = 0; cell < 64; ++cell)
      for (unsigned axis = 0; axis < 3; ++axis)
        for (unsigned low = 0; low <= positionAlong(axis, cell); ++low)
          for (unsigned high = positionAlong(axis, cell); high < 4; ++high)
            of[axis][low][high] |= std::uint64_t(1) << cell;
  }
};
const BlockMasks MASKS;

/// Of 4 x 4 x 4 cells or blocks, those within a range along an axis. \param[in] first the first of the four
std::uint64_t axisMask(std::int64_t low, std::int64_t high, std::size_t axis, std::int64_t first) {
  return MASKS.of[axis][std::max<std::int64_t>(low - first, 0)][std::min<std::int64_t>(high - first, 3)];
}

std::uint64_t cellMask(const CellRange& range, std::size_t axis, std::int64_t block) {
  return axisMask(range.low[axis], range.high[axis], axis, 4 * block);
}

std::uint64_t blockMask(const CellRange& range, std::size_t axis, std::int64_t superblock) {
  return axisMask(range.low[axis] >> 2, range.high[axis] >> 2, axis, 4 * superblock);
}

/// Calls visit(first, end, may repeat) for runs of points in the block's cells selected.
template <typename Visit>
void visitRuns(const Block& block, std::uint64_t cells, const Visit& visit) {
  while (cells != 0) {
    const auto cell = static_cast<unsigned>(__builtin_ctzll(cells));
    const std::uint64_t from_here = ~std::uint64_t(0) << cell;
    const std::uint64_t unwanted =
        block.occupied & ~cells &
        from_here; // the next occupied cell that is not selected ends the run
    const unsigned end = unwanted == 0 ? 64U : static_cast<unsigned>(__builtin_ctzll(unwanted));
    visit(std::size_t(block.first) + block.offset[cell], std::size_t(block.first) + block.offset[end], block.may_repeat);
    if (end == 64)
      return;
    cells &= ~std::uint64_t(0) << end;
  }
}

/// The superblocks that one query comes upon time and again.
class SuperblocksAround {
public:
  explicit SuperblocksAround(const NeighborGridData& data)
      : data_(data) {}

  const Superblock& at(std::uint64_t key) {
    const Superblock*& last = last_[key & 7U];
    if (last == nullptr || last->key != key)
      last = &data_.findSuperblock(key);
    return *last;
  }

private:
  const NeighborGridData& data_;
  std::array<const Superblock*, 8> last_{};
};

/// Calls visit(block, x) for the blocks of a row along x until it returns false; returns false then.
template <typename Visit>
bool visitRow(const NeighborGridData& data, const CellRange& range, std::int64_t y, std::int64_t z, SuperblocksAround& around, const Visit& visit) {
  const std::uint64_t yz_key = detail::spreadBits(static_cast<std::uint64_t>(z >> 2)) << 2 | detail::spreadBits(static_cast<std::uint64_t>(y >> 2)) << 1;
  const std::uint64_t row = axisMask(y, y, 1, y & ~std::int64_t(3)) & axisMask(z, z, 2, z & ~std::int64_t(3));
  for (std::int64_t x = range.low[0] >> 4; x <= range.high[0] >> 4; ++x) {
    const Superblock& superblock = around.at(yz_key | detail::spreadBits(static_cast<std::uint64_t>(x)));
    for (std::uint64_t bits = superblock.occupied & row & blockMask(range, 0, x); bits != 0; bits &= bits - 1) {
      const auto bit = static_cast<unsigned>(__builtin_ctzll(bits));
      if (!visit(data.blockOf(superblock, bit), 4 * x + positionAlong(0, bit)))
        return false;
    }
  }
  return true;
}

/// Calls visit(first, end, may repeat) for runs of points in the cells of the range. Returns false, with some
/// runs visited, if that would be too many points.
template <typename Visit>
bool visitRange(const NeighborGridData& data, const CellRange& range, std::size_t budget,
                const Visit& visit) {
  bool within_budget = true;
  const auto visitCounted = [&](std::size_t first, std::size_t end, bool may_repeat) {
    within_budget = within_budget && end - first <= budget;
    if (!within_budget)
      return;
    budget -= end - first;
    visit(first, end, may_repeat);
  };
  SuperblocksAround around(data);
  for (std::int64_t z = range.low[2] >> 2; z <= range.high[2] >> 2; ++z) {
    const std::uint64_t z_mask = cellMask(range, 2, z);
    for (std::int64_t y = range.low[1] >> 2; y <= range.high[1] >> 2; ++y) {
      const std::uint64_t yz_mask = z_mask & cellMask(range, 1, y);
      const bool walked = visitRow(data, range, y, z, around, [&](const Block& block, std::int64_t x) {
        if (block.crowded())
          return false;
        visitRuns(block, block.occupied & yz_mask & cellMask(range, 0, x), visitCounted);
        return within_budget;
      });
      if (!walked)
        return false;
    }
  }
  return true;
}

/// Calls visit(first, end, may repeat) for runs of points in the cells of the range, in the points' order. Returns false, with some runs visited, if the tree
/// would do better.
template <typename Visit>
bool visitInOrder(const NeighborGridData& data, const CellRange& range, const Visit& visit) {
  constexpr std::size_t MOST = 512;
  struct Place {
    const Superblock* superblock;
    std::array<std::int64_t, 3> at;
  };
  static thread_local std::vector<Place> places;
  places.clear();
  if (range.superblocks() > MOST)
    return false;
  for (std::int64_t z = range.low[2] >> 4; z <= range.high[2] >> 4; ++z)
    for (std::int64_t y = range.low[1] >> 4; y <= range.high[1] >> 4; ++y)
      for (std::int64_t x = range.low[0] >> 4; x <= range.high[0] >> 4; ++x) {
        const std::uint64_t key =
            detail::mortonKey(static_cast<std::uint64_t>(x), static_cast<std::uint64_t>(y), static_cast<std::uint64_t>(z));
        const Superblock& superblock = data.findSuperblock(key);
        if (superblock.occupied != 0)
          places.push_back({&superblock, {x, y, z}});
      }
  std::sort(places.begin(), places.end(), [](const Place& a, const Place& b) { return a.superblock->first < b.superblock->first; });
  for (const auto& [superblock, at] : places) {
    std::uint64_t bits = superblock->occupied & blockMask(range, 0, at[0]) & blockMask(range, 1, at[1]) & blockMask(range, 2, at[2]);
    for (; bits != 0; bits &= bits - 1) {
      const auto bit = static_cast<unsigned>(__builtin_ctzll(bits));
      const Block& block = data.blockOf(*superblock, bit);
      if (block.crowded())
        return false;
      std::uint64_t cells = block.occupied;
      for (unsigned axis = 0; axis < 3; ++axis)
        cells &= cellMask(range, axis, 4 * at[axis] + positionAlong(axis, bit));
      visitRuns(block, cells, visit);
    }
  }
  return true;
}

/// Working memory of a query, kept by each thread.
struct Candidates {
  std::vector<double> squared_distance;
  std::vector<std::uint32_t> position; ///< in the grid's order
  std::size_t count = 0;

  void makeRoomFor(std::size_t more) {
    if (count + more > position.size()) {
      squared_distance.resize(2 * (count + more) + 256);
      position.resize(squared_distance.size()); // last: where memory gives out, the next query makes room again
    }
  }
  Neighbor neighbor(std::size_t i, const detail::OrderedPoints& points) const { return {points.indexOf(position[i]), squared_distance[i]}; }
};
thread_local Candidates thread_candidates;

/// All points within sqrt(limit), in no order; false if the tree would do better.
bool gather(const NeighborGridData& data, const Vector3& query, double limit, std::size_t budget,
            Candidates& out) {
  const CellRange range(data.lattice, query, std::sqrt(limit));
  const double x = query.x(), y = query.y(), z = query.z();
  out.count = 0;
  if (range.blocks() > MAX_BLOCKS + std::min(budget, MANY) / POINTS_A_BLOCK)
    return false;
  return visitRange(data, range, budget, [&](std::size_t first, std::size_t end, bool) {
    out.makeRoomFor(end - first);
    double* squared_distances = out.squared_distance.data();
    std::uint32_t* positions = out.position.data();
    const Vector3* points = data.ordered.points;
    std::size_t count = out.count;
    for (std::size_t i = first; i < end; ++i) {
      const double dx = points[i].x() - x, dy = points[i].y() - y, dz = points[i].z() - z;
      const double squared_distance = dx * dx + dy * dy + dz * dz;
      squared_distances[count] = squared_distance;
      positions[count] = static_cast<std::uint32_t>(i);
      count += squared_distance <= limit ? 1 : 0;
    }
    out.count = count;
  });
}

/// A radius about the query likely to hold a few more than k points, from the density of the
/// query's block; the points are taken to lie on a sheet.
double likelyRadius(const NeighborGridData& data, const Vector3& query, std::size_t k) {
  const Block* block = data.findBlock(data.lattice.blockKey(data.lattice.fineKey(query)));
  double points_per_cell = 2.0;
  if (block != nullptr) {
    if (block->crowded())
      return -1.0;
    points_per_cell = block->count / static_cast<double>(__builtin_popcountll(block->occupied));
  }
  const auto wanted = static_cast<double>(k);
  return data.lattice.cell_size *
         std::sqrt((wanted + 2.0 + 1.3 * std::sqrt(wanted)) / (3.14159 * points_per_cell));
}

constexpr std::size_t FEW = 64;

void insertionSort(Neighbor* items, std::size_t count) {
  for (std::size_t i = 1; i < count; ++i) {
    const Neighbor item = items[i];
    std::size_t at = i;
    for (; at > 0 && closer(item, items[at - 1]); --at)
      items[at] = items[at - 1];
    items[at] = item;
  }
}

/// Sorts up to SLOTS candidates. Each one's rank is counted over 32-bit keys (the distance in float
/// with the candidate's number in its last bits): a loop without branches that compilers vectorise.
/// Insertion then puts right the few that float could not tell apart.
template <std::size_t SLOTS>
void rankSort(const Candidates& candidates, const detail::OrderedPoints& points, std::size_t k, std::vector<Neighbor>& out) {
  std::array<std::int32_t, SLOTS> keys;
  keys.fill(std::numeric_limits<std::int32_t>::max());
  for (std::size_t i = 0; i < candidates.count; ++i) {
    const auto distance = static_cast<float>(candidates.squared_distance[i]);
    std::int32_t bits = 0;
    std::memcpy(&bits, &distance, sizeof bits);
    keys[i] = (bits & ~static_cast<std::int32_t>(FEW - 1)) | static_cast<std::int32_t>(i);
  }
  std::array<Neighbor, SLOTS> items;
  for (std::size_t i = 0; i < candidates.count; ++i) {
    std::int32_t rank = 0;
    for (const std::int32_t key : keys)
      rank += key < keys[i] ? 1 : 0;
    items[static_cast<std::size_t>(rank)] = candidates.neighbor(i, points);
  }
  insertionSort(items.data(), candidates.count);
  out.assign(items.data(), items.data() + std::min(k, candidates.count));
}

/// The k nearest of the candidates, nearest first.
void sorted(const Candidates& candidates, const detail::OrderedPoints& points, std::size_t k, std::vector<Neighbor>& out) {
  if (candidates.count <= 16)
    return rankSort<16>(candidates, points, k, out);
  if (candidates.count <= 24)
    return rankSort<24>(candidates, points, k, out);
  if (candidates.count <= 32)
    return rankSort<32>(candidates, points, k, out);
  if (candidates.count <= FEW)
    return rankSort<FEW>(candidates, points, k, out);
  out.resize(candidates.count);
  for (std::size_t i = 0; i < candidates.count; ++i)
    out[i] = candidates.neighbor(i, points);
  if (k < out.size()) {
    std::nth_element(out.begin(), out.begin() + static_cast<std::ptrdiff_t>(k), out.end(), closer);
    out.resize(k);
  }
  std::sort(out.begin(), out.end(), closer);
}

/// The k nearest by cells alone, in no order; false if the tree would do better.
bool nearestInCells(const NeighborGridData& data, const Vector3& query, std::size_t k, double limit,
                    Candidates& out) {
  double radius = likelyRadius(data, query, k);
  const std::size_t budget = 256 + 16 * k;
  for (int attempt = 0; attempt < 4 && radius > 0.0; ++attempt) {
    const double squared = std::min(limit, radius * radius);
    if (!gather(data, query, squared, budget, out))
      return false;
    if (out.count >= k || squared == limit)
      return true;
    const double ratio = static_cast<double>(k + 3) / static_cast<double>(out.count + 1);
    radius *= std::min(2.5, std::max(1.25, std::sqrt(ratio)));
  }
  return false;
}

} // namespace

NeighborGrid::NeighborGrid()
    : points_(&NO_POINTS)
    , order_(std::make_shared<std::vector<Index>>())
    , data_(std::make_shared<NeighborGridData>()) {}

NeighborGrid::NeighborGrid(const Points& points, double cell_size, unsigned threads)
    : NeighborGrid(points, detail::chooseLattice(points, cell_size, threads), threads) {}

NeighborGrid::NeighborGrid(const Points& points, const detail::CellLattice& lattice, unsigned threads)
    : points_(&points) {
  auto data = std::make_shared<NeighborGridData>();
  data->lattice = lattice;
  order_ = std::make_shared<std::vector<Index>>(data->build(points, threads));
  data_ = std::move(data);
}

NeighborGrid::NeighborGrid(const Points& points, const GridKeys& keys, unsigned threads)
    : points_(&points) {
  if (keys == nullptr) {
    *this = NeighborGrid(points, 0.0, threads);
    return;
  }
  auto data = std::make_shared<NeighborGridData>();
  data->lattice = keys->lattice;
  order_ = std::make_shared<std::vector<Index>>(data->buildInOrder(points, keys->keys, threads));
  data_ = std::move(data);
}

NeighborGrid NeighborGrid::withoutThoseTakenOut(unsigned threads) const {
  if (!inOrder())
    return NeighborGrid(*points_, data_->lattice, threads);
  NeighborGrid grid = *this;
  grid.order_ = std::make_shared<std::vector<Index>>(detail::finitePoints(points_->data(), points_->size(), threads));
  return grid;
}

NeighborGrid NeighborGrid::withoutThoseTakenOut(const std::vector<Index>& taken_out, unsigned threads) const {
  if (!inOrder())
    return withoutThoseTakenOut(threads);
  auto left = std::make_shared<std::vector<Index>>();
  left->reserve(size());
  auto from = order().begin();
  for (const Index point : taken_out) {
    const auto to = std::lower_bound(from, order().end(), point);
    left->insert(left->end(), from, to);
    from = to != order().end() && *to == point ? to + 1 : to;
  }
  left->insert(left->end(), from, order().end());
  NeighborGrid grid = *this;
  grid.order_ = std::move(left);
  return grid;
}

double NeighborGrid::cellSize() const {
  return data_->lattice.cell_size;
}

const std::vector<Index>& NeighborGrid::order() const {
  return *order_;
}

bool NeighborGrid::inOrder() const {
  return data_->ordered.indices == nullptr;
}

void NeighborGrid::nearest(const Vector3& query, std::size_t k, std::vector<Neighbor>& out,
                           double max_distance) const {
  out.clear();
  k = std::min(k, size());
  if (k == 0 || !query.allFinite() || !(max_distance >= 0.0))
    return;
  const double limit = max_distance * max_distance;
  Candidates& candidates = thread_candidates;
  if (k < size() && nearestInCells(*data_, query, k, limit, candidates)) {
    sorted(candidates, data_->ordered, k, out);
  } else {
    data_->tree.nearest(data_->ordered, query, k, limit, out);
    std::sort(out.begin(), out.end(), closer);
  }
}

void NeighborGrid::within(const Vector3& query, double radius, std::vector<Neighbor>& out) const {
  out.clear();
  if (size() == 0 || !query.allFinite() || !(radius >= 0.0))
    return;
  const double limit = radius * radius;
  Candidates& candidates = thread_candidates;
  if (gather(*data_, query, limit, std::numeric_limits<std::size_t>::max(), candidates)) {
    sorted(candidates, data_->ordered, candidates.count, out);
  } else {
    data_->tree.visitWithin(data_->ordered, query, limit, [&](std::size_t i, double squared_distance) {
      out.push_back({data_->ordered.indexOf(i), squared_distance});
    });
    std::sort(out.begin(), out.end(), closer);
  }
}

void NeighborGrid::runsAround(const Vector3& query, double radius, std::vector<PointRun>& runs) const {
  runsAround(Bounds{query, query}, radius, runs);
}

void NeighborGrid::runsAround(const Bounds& box, double radius, std::vector<PointRun>& runs) const {
  runs.clear();
  if (size() == 0 || box.empty() || !box.low.allFinite() || !box.high.allFinite() || !(radius >= 0.0))
    return;
  const detail::OrderedPoints& ordered = data_->ordered;
  const auto add = [&](std::size_t first, std::size_t end, bool may_repeat) {
    runs.push_back({ordered.points + first, end - first, ordered.indices == nullptr ? nullptr : ordered.indices + first, static_cast<Index>(first),
                    may_repeat});
  };
  const CellRange range(data_->lattice, box, radius);
  if (range.blocks() <= MAX_BLOCKS && visitRange(*data_, range, std::numeric_limits<std::size_t>::max(), add))
    return;
  std::size_t last = ordered.count;
  const auto addOrLengthen = [&](std::size_t first, std::size_t end, bool may_repeat) {
    if (first == last) {
      runs.back().count += end - first;
      runs.back().may_repeat |= may_repeat;
    } else {
      add(first, end, may_repeat);
    }
    last = end;
  };
  runs.clear();
  if (visitInOrder(*data_, range, addOrLengthen))
    return;
  runs.clear();
  last = ordered.count;
  data_->tree.visitLeaves(ordered.count, box, radius * radius, [&](std::size_t first, std::size_t end) { addOrLengthen(first, end, true); });
}

void NeighborGrid::collectWithin(const Vector3& query, double radius, PointsAround& out) const {
  static thread_local std::vector<PointRun> runs;
  runsAround(query, radius, runs);
  const double limit = radius * radius;
  std::size_t most = 0;
  for (const PointRun& run : runs)
    most += run.count;
  if (most > out.index.size()) {
    for (std::vector<double>* values : {&out.dx, &out.dy, &out.dz, &out.squared_distance})
      values->resize(2 * most);
    out.index.resize(2 * most);
  }
  double *dx = out.dx.data(), *dy = out.dy.data(), *dz = out.dz.data(), *squared_distance = out.squared_distance.data();
  Index* index = out.index.data();
  std::size_t count = 0;
  for (const PointRun& run : runs)
    for (std::size_t i = 0; i < run.count; ++i) {
      const Vector3& p = run.points[i];
      const double x = p.x() - query.x(), y = p.y() - query.y(), z = p.z() - query.z();
      const double squared = x * x + y * y + z * z;
      dx[count] = x;
      dy[count] = y;
      dz[count] = z;
      squared_distance[count] = squared;
      index[count] = run.index(i);
      count += squared <= limit ? 1 : 0;
    }
  out.count = count;
}

Neighbor NeighborGrid::nearestOne(const Vector3& query, double max_distance) const {
  Neighbor best;
  best.squared_distance = std::numeric_limits<double>::infinity();
  if (size() == 0 || !query.allFinite() || !(max_distance >= 0.0))
    return best;
  const NeighborGridData& data = *data_;
  const double limit = max_distance * max_distance;
  double squared = data.lattice.cell_size * data.lattice.cell_size * 0.25; // half a cell holds one nearly always
  for (int attempt = 0; attempt < 5; ++attempt, squared *= 4.0) {
    const CellRange range(data.lattice, query, std::sqrt(std::min(squared, limit)));
    const bool done =
        range.blocks() <= MAX_BLOCKS &&
        visitRange(data, range, 1024, [&](std::size_t first, std::size_t end, bool) {
          for (std::size_t i = first; i < end; ++i) {
            const Neighbor candidate{data.ordered.indexOf(i), data.ordered.squaredDistance(i, query)};
            if (closer(candidate, best))
              best = candidate;
          }
        });
    if (!done)
      break;
    if (best.squared_distance <= squared || squared >= limit)
      return best.squared_distance <= limit ? best
                                            : Neighbor{-1, std::numeric_limits<double>::infinity()};
  }
  return data.tree.nearestOne(data.ordered, query, limit);
}

std::vector<Index> spaceOrder(const Points& points, unsigned threads, GridKeys* keys) {
  auto sorted = std::make_shared<detail::SortedKeys>();
  sorted->lattice = detail::chooseLattice(points, 0.0, threads);
  std::vector<Index> order = detail::sortByKey(points, *sorted, threads);
  for (std::size_t i = 0; order.size() < points.size() && i < points.size(); ++i)
    if (!points[i].allFinite())
      order.push_back(static_cast<Index>(i));
  if (keys != nullptr)
    *keys = std::move(sorted);
  return order;
}

} // namespace graben
