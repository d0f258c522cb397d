#include "occupied_cells.h"

#include "graben/surface/sheet_extraction.h"

#include <cmath>
#include <sstream>

namespace graben {

void joinEqual(std::vector<KeyedMask>& entries) {
  std::sort(entries.begin(), entries.end(), [](const KeyedMask& a, const KeyedMask& b) { return a.key < b.key; });
  std::size_t kept = 0;
  for (const KeyedMask& entry : entries) {
    if (kept > 0 && entries[kept - 1].key == entry.key)
      entries[kept - 1].mask |= entry.mask;
    else
      entries[kept++] = entry;
  }
  entries.resize(kept);
}

void refuseVoxelSize(double voxel_size, double excess, double least) {
  const double fits = 1.2 * std::max(least, voxel_size * std::sqrt(excess));
  std::ostringstream message;
  message.precision(3);
  message << "the surface at voxel size " << voxel_size;
  if (excess > 1.0)
    message << " does not fit into memory; a voxel size of " << fits << " would";
  else
    message << " has more than " << kLatticeLimit << " voxels to a side; a voxel size of " << fits << " would do, or leave out picks far from all others";
  throw ResourceError("marching cubes", message.str());
}

namespace {

/// The largest coordinate of finite points, from an origin.
double farthest(const Points& points, const Vector3& origin, unsigned threads) {
  constexpr std::size_t grain = 1 << 15;
  std::vector<double> parts((points.size() + grain - 1) / grain, 0.0);
  parallelBlocks(points.size(), grain, threads, [&](std::size_t begin, std::size_t end) {
    double far = 0.0;
    for (std::size_t i = begin; i < end; ++i)
      if (points[i].allFinite())
        far = std::max(far, (points[i] - origin).cwiseAbs().maxCoeff());
    parts[begin / grain] = far;
  });
  return *std::max_element(parts.begin(), parts.end());
}

/// How many cells hold picks of one run of picks in every \a stride runs.
double cellsWithPicks(const NeighborGrid& grid, const Lattice& lattice, std::size_t stride, unsigned threads) {
  constexpr std::size_t run = 8192;
  const std::vector<Index>& order = grid.order();
  const std::size_t runs = (order.size() + run * stride - 1) / (run * stride);
  const auto place = [&](std::size_t i) {
    const std::size_t at = i / run * stride * run + i % run;
    return grid.points()[static_cast<std::size_t>(order[std::min(at, order.size() - 1)])];
  };
  double cells = 0.0;
  for (const KeyedMask& entry : occupiedCells(runs * run, place, lattice, threads))
    cells += block::count(entry.mask);
  return cells;
}

} // namespace

void checkSurfaceMemory(const NeighborGrid& grid, const Lattice& lattice, double reach, std::size_t memory_limit, double least, unsigned threads) {
  if (grid.size() == 0 || memory_limit == 0)
    return;
  // The surface goes on from the picks by the reach: what it takes at most, and then as a rule, in cells of that size.
  Lattice coarse = lattice;
  coarse.voxel_size = std::max({reach, lattice.voxel_size, 4.0 * least});
  const double each = std::pow(coarse.voxel_size / lattice.voxel_size, 2.0) * kBytesOfBlock / 16.0;
  const auto limit = static_cast<double>(memory_limit);
  if (9.0 * static_cast<double>(grid.size()) * each <= limit)
    return;
  constexpr std::size_t stride = 16; // a sample that finds plenty of room does
  if (2.0 * stride * cellsWithPicks(grid, coarse, stride, threads) * each <= limit)
    return;
  const double excess = cellsWithPicks(grid, coarse, 1, threads) * each / limit;
  if (excess > 1.0)
    refuseVoxelSize(lattice.voxel_size, excess, least);
}

void checkVoxelSize(const NeighborGrid& grid, const Lattice& lattice, double reach, std::size_t memory_limit, unsigned threads) {
  if (grid.size() == 0)
    return;
  const double least = farthest(grid.points(), lattice.origin, threads) / kLatticeLimit;
  checkSurfaceMemory(grid, lattice, reach, memory_limit, least, threads);
  if (least > lattice.voxel_size)
    refuseVoxelSize(lattice.voxel_size, 0.0, least);
}

} // namespace graben
