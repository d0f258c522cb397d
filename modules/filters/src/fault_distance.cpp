#include "graben/filters/fault_distance.h"

#include "graben/core/errors.h"
#include "graben/core/threads.h"

#include <cmath>

namespace graben {

std::vector<double> distancesToFaults(const Points& points, const FaultNetwork& faults,
                                      double limit, const std::vector<Index>* order,
                                      unsigned threads) {
  if (!(limit >= 0.0))
    throw InvalidInputError("finding picks near faults",
                            "The width must be zero or positive, in the picks' units.");
  constexpr std::size_t GRAIN = 128;
  std::vector<double> distances(points.size(), std::numeric_limits<double>::infinity());
  const auto pick = [&](std::size_t i) {
    return order != nullptr ? static_cast<std::size_t>((*order)[i]) : i;
  };
  const std::size_t count = order != nullptr ? order->size() : points.size();
  parallelBlocks(count, GRAIN, threads, [&](std::size_t begin, std::size_t end) {
    Bounds box;
    for (std::size_t i = begin; i < end; ++i)
      if (points[pick(i)].allFinite())
        box.extend(points[pick(i)]);
    if (box.empty())
      return;
    box.low.array() -= limit;
    box.high.array() += limit;
    if (!faults.mayTouch(box))
      return;
    for (std::size_t i = begin; i < end; ++i) {
      const Vector3& p = points[pick(i)];
      const FaultPoint near = p.allFinite() ? faults.nearest(p, limit) : FaultPoint{};
      if (near.fault >= 0)
        distances[pick(i)] = near.distance;
    }
  });
  return distances;
}

} // namespace graben
