#include "graben/features/neighbor_grid.h"

#include "neighbor_grid_data.h"

#include <algorithm>
#include <cmath>

namespace graben {
namespace {

using detail::Block;
using detail::closer;
using detail::NeighborGridData;

const Points NO_POINTS;
constexpr std::int64_t MAX_BLOCKS = 64; // visited by one query; beyond, the tree is faster

/// Cells that a cube around a query overlaps.
struct CellRange {
  std::array<std::int64_t, 3> low, high;

  CellRange(const detail::CellLattice& lattice, const Vector3& query, double half_edge) {
    for (int axis = 0; axis < 3; ++axis) {
      // Rounding must not shut out a point that lies on the cube.
      const double reach = half_edge * (1.0 + 1e-12) + 1e-15 * std::abs(query[axis]);
      low[static_cast<std::size_t>(axis)] = lattice.cell(query[axis] - reach, axis);
      high[static_cast<std::size_t>(axis)] = lattice.cell(query[axis] + reach, axis);
    }
  }
  std::int64_t blocks() const {
    std::int64_t count = 1;
    for (std::size_t axis = 0; axis < 3; ++axis)
      count *= std::min<std::int64_t>((high[axis] >> 2) - (low[axis] >> 2) + 1, MAX_BLOCKS + 1);
    return count;
  }
};

/// For each axis and range of the 4 cells along it, the cells of a block within.
struct BlockMasks {
  std::uint64_t of[3][4][4] = {};
  BlockMasks() {
    for (unsigned cell = 0; cell < 64; ++cell) {
      const unsigned position[3] = {(cell & 1U) | (cell >> 2 & 2U), (cell >> 1 & 1U) | (cell >> 3 & 2U),
                                    (cell >> 2 & 1U) | (cell >> 4 & 2U)};
      for (unsigned axis = 0; axis < 3; ++axis)
        for (unsigned low = 0; low <= position[axis]; ++low)
          for (unsigned high = position[axis]; high < 4; ++high)
            of[axis][low][high] |= std::uint64_t(1) << cell;
    }
  }
};
const BlockMasks MASKS;

std::uint64_t axisMask(const CellRange& range, std::size_t axis, std::int64_t block) {
  const std::int64_t low = std::max<std::int64_t>(range.low[axis] - 4 * block, 0);
  const std::int64_t high = std::min<std::int64_t>(range.high[axis] - 4 * block, 3);
  return MASKS.of[axis][low][high];
}

/// Calls visit(first, end) for runs of points in the cells of the range. Returns false, with some runs visited, if that would be too many points.
template <typename Visit>
bool visitRange(const NeighborGridData& data, const CellRange& range, std::size_t budget, const Visit& visit) {
  for (std::int64_t z = range.low[2] >> 2; z <= range.high[2] >> 2; ++z) {
    const std::uint64_t z_mask = axisMask(range, 2, z);
    for (std::int64_t y = range.low[1] >> 2; y <= range.high[1] >> 2; ++y) {
      const std::uint64_t yz_mask = z_mask & axisMask(range, 1, y);
      for (std::int64_t x = range.low[0] >> 2; x <= range.high[0] >> 2; ++x) {
        const Block* block = data.findBlock(detail::mortonKey(static_cast<std::uint64_t>(x), static_cast<std::uint64_t>(y),
                                                              static_cast<std::uint64_t>(z)));
        if (block == nullptr)
          continue;
        if (block->crowded())
          return false;
        std::uint64_t cells = block->occupied & yz_mask & axisMask(range, 0, x);
        while (cells != 0) {
          const auto cell = static_cast<unsigned>(__builtin_ctzll(cells));
          cells &= cells - 1;
          const std::size_t first = block->first + block->offset[cell];
          const std::size_t end = block->first + block->offset[cell + 1];
          if (end - first > budget)
            return false;
          budget -= end - first;
          visit(first, end);
        }
      }
    }
  }
  return true;
}

/// All points within sqrt(limit), in no order; false if the tree would do better.
bool gather(const NeighborGridData& data, const Vector3& query, double limit, std::size_t budget, std::vector<Neighbor>& out) {
  const CellRange range(data.lattice, query, std::sqrt(limit));
  out.clear();
  if (range.blocks() > MAX_BLOCKS)
    return false;
  return visitRange(data, range, budget, [&](std::size_t first, std::size_t end) {
    std::size_t count = out.size();
    out.resize(count + (end - first));
    for (std::size_t i = first; i < end; ++i) {
      const double squared_distance = data.ordered.squaredDistance(i, query);
      out[count] = {data.ordered.index[i], squared_distance};
      count += squared_distance <= limit ? 1 : 0;
    }
    out.resize(count);
  });
}

/// A radius about the query likely to hold a few more than k points, from the density of the query's block; the points are taken to lie on a sheet.
double likelyRadius(const NeighborGridData& data, const Vector3& query, std::size_t k) {
  const Block* block = data.findBlock(data.lattice.blockKey(data.lattice.fineKey(query)));
  double points_per_cell = 2.0;
  if (block != nullptr) {
    if (block->crowded())
      return -1.0;
    points_per_cell = block->count / static_cast<double>(__builtin_popcountll(block->occupied));
  }
  const auto wanted = static_cast<double>(k);
  return data.lattice.cell_size * std::sqrt((wanted + 2.0 + 1.3 * std::sqrt(wanted)) / (3.14159 * points_per_cell));
}

void sortByDistance(std::vector<Neighbor>& neighbors) {
  constexpr std::size_t FEW = 48;
  if (neighbors.size() > FEW) {
    std::sort(neighbors.begin(), neighbors.end(), closer);
    return;
  }
  for (std::size_t i = 1; i < neighbors.size(); ++i) {
    const Neighbor item = neighbors[i];
    std::size_t at = i;
    for (; at > 0 && closer(item, neighbors[at - 1]); --at)
      neighbors[at] = neighbors[at - 1];
    neighbors[at] = item;
  }
}

/// The k nearest by cells alone, in no order; false if the tree would do better.
bool nearestInCells(const NeighborGridData& data, const Vector3& query, std::size_t k, double limit, std::vector<Neighbor>& out) {
  double radius = likelyRadius(data, query, k);
  const std::size_t budget = 256 + 16 * k;
  for (int attempt = 0; attempt < 4 && radius > 0.0; ++attempt) {
    const double squared = std::min(limit, radius * radius);
    if (!gather(data, query, squared, budget, out))
      return false;
    if (out.size() >= k || squared == limit)
      return true;
    const double ratio = static_cast<double>(k + 3) / static_cast<double>(out.size() + 1);
    radius *= std::min(2.5, std::max(1.25, std::sqrt(ratio)));
  }
  return false;
}

} // namespace

NeighborGrid::NeighborGrid() : points_(&NO_POINTS), data_(std::make_shared<NeighborGridData>()) {}

NeighborGrid::NeighborGrid(const Points& points, double cell_size, unsigned threads) : points_(&points) {
  auto data = std::make_shared<NeighborGridData>();
  data->build(points, cell_size, threads);
  data_ = std::move(data);
}

double NeighborGrid::cellSize() const { return data_->lattice.cell_size; }

const std::vector<Index>& NeighborGrid::order() const { return data_->ordered.index; }

void NeighborGrid::nearest(const Vector3& query, std::size_t k, std::vector<Neighbor>& out, double max_distance) const {
  out.clear();
  k = std::min(k, size());
  if (k == 0 || !query.allFinite() || !(max_distance >= 0.0))
    return;
  const double limit = max_distance * max_distance;
  if (k == size() || !nearestInCells(*data_, query, k, limit, out))
    data_->tree.nearest(data_->ordered, query, k, limit, out);
  if (out.size() > 2 * k + 16) {
    std::nth_element(out.begin(), out.begin() + static_cast<std::ptrdiff_t>(k), out.end(), closer);
    out.resize(k);
  }
  sortByDistance(out);
  if (out.size() > k)
    out.resize(k);
}

void NeighborGrid::within(const Vector3& query, double radius, std::vector<Neighbor>& out) const {
  out.clear();
  if (size() == 0 || !query.allFinite() || !(radius >= 0.0))
    return;
  const double limit = radius * radius;
  if (!gather(*data_, query, limit, std::numeric_limits<std::size_t>::max(), out))
    data_->tree.within(data_->ordered, query, limit, out);
  sortByDistance(out);
}

Neighbor NeighborGrid::nearestOne(const Vector3& query, double max_distance) const {
  Neighbor best;
  best.squared_distance = std::numeric_limits<double>::infinity();
  if (size() == 0 || !query.allFinite() || !(max_distance >= 0.0))
    return best;
  const NeighborGridData& data = *data_;
  const double limit = max_distance * max_distance;
  double squared = data.lattice.cell_size * data.lattice.cell_size * 0.5;
  for (int attempt = 0; attempt < 3; ++attempt, squared *= 4.0) {
    const CellRange range(data.lattice, query, std::sqrt(std::min(squared, limit)));
    const bool done = range.blocks() <= MAX_BLOCKS && visitRange(data, range, 256, [&](std::size_t first, std::size_t end) {
      for (std::size_t i = first; i < end; ++i) {
        const Neighbor candidate{data.ordered.index[i], data.ordered.squaredDistance(i, query)};
        if (closer(candidate, best))
          best = candidate;
      }
    });
    if (!done)
      break;
    if (best.squared_distance <= squared || squared >= limit)
      return best.squared_distance <= limit ? best : Neighbor{-1, std::numeric_limits<double>::infinity()};
  }
  return data.tree.nearestOne(data.ordered, query, limit);
}

} // namespace graben
