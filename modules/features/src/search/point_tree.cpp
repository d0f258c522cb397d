#include "search/point_tree.h"

#include "graben/core/threads.h"

#include <algorithm>
#include <array>

namespace graben::detail {
void PointTree::build(const OrderedPoints& points, unsigned threads) {
  levels_.clear();
  const std::size_t count = points.count;
  if (count == 0)
    return;
  std::vector<Node> leaves((count + FAN - 1) / FAN);
  parallelFor(leaves.size(), 4096, threads, [&](std::size_t n) {
    const std::size_t end = std::min(count, (n + 1) * FAN);
    for (std::size_t i = n * FAN; i < end; ++i)
      if (points.points[i].allFinite())
        leaves[n].extend({points.points[i], points.points[i], points.indexOf(i)});
  });
  levels_.push_back(std::move(leaves));
  while (levels_.back().size() > 1) {
    const std::vector<Node>& below = levels_.back();
    std::vector<Node> level((below.size() + FAN - 1) / FAN);
    for (std::size_t n = 0; n < level.size(); ++n)
      for (std::size_t c = n * FAN; c < std::min(below.size(), (n + 1) * FAN); ++c)
        level[n].extend(below[c]);
    levels_.push_back(std::move(level));
  }
}

void PointTree::nearest(const OrderedPoints& points, const Vector3& query, std::size_t k,
                        double limit, std::vector<Neighbor>& out) const {
  out.clear();
  if (k == 0)
    return;
  const auto prune = [&](double squared_distance, Index least_index) {
    if (out.size() < k)
      return !(squared_distance <= limit);
    const Neighbor& worst = out.front();
    return squared_distance > worst.squared_distance ||
           (squared_distance == worst.squared_distance && least_index > worst.index);
  };
  traverse(points.count, query, prune, [&](std::size_t i) {
    const Neighbor candidate{points.indexOf(i), points.squaredDistance(i, query)};
    if (out.size() < k) {
      if (!(candidate.squared_distance <= limit))
        return;
      out.push_back(candidate);
      std::push_heap(out.begin(), out.end(), closer);
    } else if (closer(candidate, out.front())) {
      std::pop_heap(out.begin(), out.end(), closer);
      out.back() = candidate;
      std::push_heap(out.begin(), out.end(), closer);
    }
  });
}

Neighbor PointTree::nearestOne(const OrderedPoints& points, const Vector3& query,
                               double limit) const {
  Neighbor best{std::numeric_limits<Index>::max(), limit};
  const auto prune = [&best](double squared_distance, Index least_index) {
    return squared_distance > best.squared_distance ||
           (squared_distance == best.squared_distance && least_index > best.index);
  };
  traverse(points.count, query, prune, [&](std::size_t i) {
    const Neighbor candidate{points.indexOf(i), points.squaredDistance(i, query)};
    if (closer(candidate, best))
      best = candidate;
  });
  if (best.index == std::numeric_limits<Index>::max())
    return {-1, std::numeric_limits<double>::infinity()};
  return best;
}

} // namespace graben::detail
