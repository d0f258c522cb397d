#include "graben/mesh/bounds.h"

#include "graben/core/threads.h"

#include <vector>

namespace graben {

Bounds boundsOf(const Points& points, unsigned threads) {
  constexpr std::size_t kGrain = 1 << 15;
  std::vector<Bounds> blocks((points.size() + kGrain - 1) / kGrain);
  parallelBlocks(points.size(), kGrain, threads, [&](std::size_t begin, std::size_t end) {
    Bounds block;
    for (std::size_t i = begin; i < end; ++i)
      if (points[i].allFinite())
        block.extend(points[i]);
    blocks[begin / kGrain] = block;
  });
  Bounds bounds;
  for (const Bounds& block : blocks)
    bounds.extend(block);
  return bounds;
}

} // namespace graben
