#include "graben/filters/mean_distance.h"

#include "graben/core/threads.h"

#include <algorithm>
#include <cmath>

namespace graben {

double meanPickDistance(const NeighborGrid& grid, unsigned threads) {
  constexpr std::size_t NEAREST = 8, SAMPLES = 8000, GRAIN = 256;
  const std::size_t count = std::min(SAMPLES, grid.size());
  std::vector<double> found(count, 0.0);
  parallelBlocks(count, GRAIN, threads, [&](std::size_t begin, std::size_t end) {
    std::vector<Neighbor> near;
    for (std::size_t i = begin; i < end; ++i) {
      const auto pick = static_cast<std::size_t>(grid.order()[i * grid.size() / count]);
      grid.nearest(grid.points()[pick], NEAREST + 1, near);
      if (near.size() > 1)
        found[i] =
            std::sqrt(M_PI * near.back().squared_distance / static_cast<double>(near.size() - 1));
    }
  });
  // Picks that coincide with all their neighbours say nothing.
  found.erase(std::remove(found.begin(), found.end(), 0.0), found.end());
  if (found.empty())
    return 0.0;
  const auto middle = found.begin() + static_cast<std::ptrdiff_t>(found.size() / 2);
  std::nth_element(found.begin(), middle, found.end());
  return *middle;
}

} // namespace graben
