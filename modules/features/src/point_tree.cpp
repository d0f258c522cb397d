#include "point_tree.h"

#include "graben/core/threads.h"

#include <algorithm>
#include <array>

namespace graben::detail {
namespace {

constexpr std::size_t FAN = 8;
constexpr std::size_t MAX_STACK = FAN * 12; // 12 levels of 8 hold more points than an Index counts

struct Entry {
  double squared_distance;
  Index least_index;
  std::uint32_t level;
  std::size_t node;
};

bool later(const Entry& a, const Entry& b) {
  return a.squared_distance > b.squared_distance ||
         (a.squared_distance == b.squared_distance && a.least_index > b.least_index);
}

} // namespace

void PointTree::build(const OrderedPoints& points, unsigned threads) {
  levels_.clear();
  const std::size_t count = points.index.size();
  if (count == 0)
    return;
  std::vector<Node> leaves((count + FAN - 1) / FAN);
  parallelFor(leaves.size(), 4096, threads, [&](std::size_t n) {
    const std::size_t begin = n * FAN, end = std::min(count, begin + FAN);
    Node node{Vector3(points.x[begin], points.y[begin], points.z[begin]), Vector3::Zero(),
              points.index[begin]};
    node.high = node.low;
    for (std::size_t i = begin + 1; i < end; ++i) {
      const Vector3 p(points.x[i], points.y[i], points.z[i]);
      node.low = node.low.cwiseMin(p);
      node.high = node.high.cwiseMax(p);
      node.least_index = std::min(node.least_index, points.index[i]);
    }
    leaves[n] = node;
  });
  levels_.push_back(std::move(leaves));
  while (levels_.back().size() > 1) {
    const std::vector<Node>& below = levels_.back();
    std::vector<Node> level((below.size() + FAN - 1) / FAN);
    for (std::size_t n = 0; n < level.size(); ++n) {
      level[n] = below[n * FAN];
      for (std::size_t c = n * FAN + 1; c < std::min(below.size(), (n + 1) * FAN); ++c) {
        level[n].low = level[n].low.cwiseMin(below[c].low);
        level[n].high = level[n].high.cwiseMax(below[c].high);
        level[n].least_index = std::min(level[n].least_index, below[c].least_index);
      }
    }
    levels_.push_back(std::move(level));
  }
}

/// Nearest nodes first; prune(squared distance, least index) is asked before a node is opened,
/// visit(i) gets each point of an opened leaf.
template <typename Prune, typename Visit>
void PointTree::traverse(std::size_t points, const Vector3& query, const Prune& prune,
                         const Visit& visit) const {
  if (levels_.empty())
    return;
  std::array<Entry, MAX_STACK> stack;
  const Node& root = levels_.back().front();
  stack[0] = {root.squaredDistance(query), root.least_index,
              static_cast<std::uint32_t>(levels_.size() - 1), 0};
  std::size_t top = 1;
  while (top > 0) {
    const Entry entry = stack[--top];
    if (prune(entry.squared_distance, entry.least_index))
      continue;
    const std::size_t begin = entry.node * FAN;
    if (entry.level == 0) {
      for (std::size_t i = begin; i < std::min(points, begin + FAN); ++i)
        visit(i);
      continue;
    }
    const std::vector<Node>& children = levels_[entry.level - 1];
    const std::size_t first = top;
    for (std::size_t c = begin; c < std::min(children.size(), begin + FAN); ++c) {
      const Entry child{children[c].squaredDistance(query), children[c].least_index,
                        entry.level - 1, c};
      if (prune(child.squared_distance, child.least_index))
        continue;
      std::size_t at = top++;
      for (; at > first && later(child, stack[at - 1]); --at)
        stack[at] = stack[at - 1];
      stack[at] = child;
    }
  }
}

void PointTree::nearest(const OrderedPoints& points, const Vector3& query, std::size_t k,
                        double limit, std::vector<Neighbor>& out) const {
  out.clear();
  if (k == 0)
    return;
  const auto prune = [&](double squared_distance, Index least_index) {
    if (out.size() < k)
      return squared_distance > limit;
    const Neighbor& worst = out.front();
    return squared_distance > worst.squared_distance ||
           (squared_distance == worst.squared_distance && least_index > worst.index);
  };
  traverse(points.index.size(), query, prune, [&](std::size_t i) {
    const Neighbor candidate{points.index[i], points.squaredDistance(i, query)};
    if (out.size() < k) {
      if (candidate.squared_distance > limit)
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
  traverse(points.index.size(), query, prune, [&](std::size_t i) {
    const Neighbor candidate{points.index[i], points.squaredDistance(i, query)};
    if (closer(candidate, best))
      best = candidate;
  });
  if (best.index == std::numeric_limits<Index>::max())
    return {-1, std::numeric_limits<double>::infinity()};
  return best;
}

void PointTree::within(const OrderedPoints& points, const Vector3& query, double limit,
                       std::vector<Neighbor>& out) const {
  out.clear();
  traverse(
      points.index.size(), query,
      [&](double squared_distance, Index) { return squared_distance > limit; },
      [&](std::size_t i) {
        const double squared_distance = points.squaredDistance(i, query);
        if (squared_distance <= limit)
          out.push_back({points.index[i], squared_distance});
      });
}

} // namespace graben::detail
