#include "graben/features/mean_distance.h"

#include "graben/core/threads.h"

#include <algorithm>
#include <cmath>

namespace graben {

namespace {

constexpr std::size_t kNearest = 9; // the pick itself and eight more
constexpr std::size_t kSample = 20000;

/// Side of the square that is one pick's share of the disc its nearest cover; 0 if all coincide.
double shareAround(const Vector3& pick, const NeighborGrid& grid, std::vector<Neighbor>& near) {
  grid.nearest(pick, kNearest, near);
  std::size_t copies = 0;
  while (copies < near.size() && near[copies].squared_distance == 0.0)
    ++copies;
  const double distinct =
      static_cast<double>(near.size() - copies) / static_cast<double>(std::max<std::size_t>(copies, 1));
  return distinct > 0.0 ? std::sqrt(near.back().squared_distance * M_PI / distinct) : 0.0;
}

} // namespace

double meanPickDistance(const NeighborGrid& grid, unsigned threads) {
  const std::vector<Index>& order = grid.order();
  const std::size_t step = std::max<std::size_t>(1, order.size() / kSample);
  std::vector<double> shares((order.size() + step - 1) / step, 0.0);
  parallelBlocks(shares.size(), 256, threads, [&](std::size_t begin, std::size_t end) {
    std::vector<Neighbor> near;
    for (std::size_t i = begin; i < end; ++i)
      shares[i] = shareAround(grid.points()[static_cast<std::size_t>(order[i * step])], grid, near);
  });
  // Picks that coincide with all their neighbours say nothing.
  shares.erase(std::remove(shares.begin(), shares.end(), 0.0), shares.end());
  if (shares.empty())
    return 0.0;
  const auto middle = shares.begin() + static_cast<std::ptrdiff_t>(shares.size() / 2);
  std::nth_element(shares.begin(), middle, shares.end());
  return *middle;
}

} // namespace graben
