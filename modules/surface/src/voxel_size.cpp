#include "graben/surface/voxel_size.h"

#include "graben/core/threads.h"

#include <algorithm>
#include <cmath>

namespace graben {

double estimateVoxelSize(const NeighborGrid& grid, unsigned threads) {
  constexpr std::size_t kNearest = 9; // the pick itself and eight more
  constexpr std::size_t kSample = 20000;
  const std::vector<Index>& order = grid.order();
  const std::size_t step = std::max<std::size_t>(1, order.size() / kSample);
  std::vector<double> distances((order.size() + step - 1) / step, 0.0);
  parallelBlocks(distances.size(), 256, threads, [&](std::size_t begin, std::size_t end) {
    std::vector<Neighbor> near;
    for (std::size_t i = begin; i < end; ++i) {
      grid.nearest(grid.points()[static_cast<std::size_t>(order[i * step])], kNearest, near);
      if (near.size() > 1)
        distances[i] =
            std::sqrt(near.back().squared_distance * M_PI / static_cast<double>(near.size() - 1));
    }
  });
  distances.erase(std::remove(distances.begin(), distances.end(), 0.0), distances.end());
  if (distances.empty())
    return 0.0;
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  return *middle;
}

} // namespace graben
