#include "neighbor_graph.h"

#include "graben/core/threads.h"
#include "graben/mesh/bounds.h"
#include "radix_sort.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace graben::detail {
namespace {

constexpr std::size_t GRAIN = 2048;

} // namespace

NeighborGraph::NeighborGraph(const NeighborGrid& grid, const FaultNetwork& faults,
                             const OrientationOptions& options, const Points& normals)
    : grid_(grid)
    , faults_(faults)
    , options_(options)
    , points_(grid.size())
    , normals_(grid.size())
    , width_(std::max<std::size_t>(options.neighbors, 1)) {
  parallelFor(grid.size(), GRAIN, options.threads, [&](std::size_t node) {
    const auto pick = static_cast<std::size_t>(grid.order()[node]);
    points_[node] = grid.points()[pick];
    normals_[node] = normals[pick];
  });
  findNeighbors();
}

void NeighborGraph::findNeighbors() {
  const std::vector<Index>& order = grid_.order();
  std::vector<Index> position(grid_.points().size(), -1);
  for (std::size_t node = 0; node < order.size(); ++node)
    if (normals_[node].allFinite())
      position[static_cast<std::size_t>(order[node])] = static_cast<Index>(node);
  const double longest = options_.rho_plus_delta > 0.0 ? options_.rho_plus_delta
                                                       : std::numeric_limits<double>::infinity();
  neighbors_.assign(order.size() * width_, -1);
  reach_.assign(order.size(), 0.0);
  parallelBlocks(order.size(), GRAIN, options_.threads, [&](std::size_t begin, std::size_t end) {
    std::vector<Neighbor> found;
    for (std::size_t node = begin; node < end; ++node) {
      if (position[static_cast<std::size_t>(order[node])] < 0)
        continue;
      grid_.nearest(points_[node], width_ + 1, found, longest);
      reach_[node] = found.size() > width_ ? found.back().squared_distance
                                           : std::numeric_limits<double>::infinity();
      std::size_t slot = node * width_;
      for (const Neighbor& neighbor : found)
        if (neighbor.index != order[node] && slot < (node + 1) * width_)
          neighbors_[slot++] = position[static_cast<std::size_t>(neighbor.index)];
      dropCrossing(node);
    }
  });
}

/// Takes out the neighbours on the other side of a fault.
void NeighborGraph::dropCrossing(std::size_t node) {
  if (faults_.empty())
    return;
  Bounds box;
  box.extend(points_[node]);
  for (std::size_t slot = node * width_; slot < (node + 1) * width_; ++slot)
    if (neighbors_[slot] >= 0)
      box.extend(points_[static_cast<std::size_t>(neighbors_[slot])]);
  if (!faults_.mayTouch(box))
    return;
  for (std::size_t slot = node * width_; slot < (node + 1) * width_; ++slot)
    if (neighbors_[slot] >= 0 &&
        faults_.crosses(points_[node], points_[static_cast<std::size_t>(neighbors_[slot])]))
      neighbors_[slot] = -1;
}

float NeighborGraph::weight(std::size_t from, std::size_t to) const {
  return static_cast<float>(std::max(0.0, 1.0 - std::abs(normals_[from].dot(normals_[to]))));
}

std::vector<NeighborGraph::Edge> NeighborGraph::sortedEdges() const {
  const std::size_t nodes = reach_.size();
  std::vector<std::vector<KeyedIndex>> parts((nodes + GRAIN - 1) / GRAIN);
  parallelBlocks(nodes, GRAIN, options_.threads, [&](std::size_t begin, std::size_t end) {
    std::vector<KeyedIndex>& part = parts[begin / GRAIN];
    for (std::size_t slot = begin * width_; slot < end * width_; ++slot) {
      if (neighbors_[slot] < 0)
        continue;
      const std::size_t from = slot / width_;
      const auto to = static_cast<std::size_t>(neighbors_[slot]);
      if (from > to && (points_[from] - points_[to]).squaredNorm() < reach_[to])
        continue; // the other end has this edge too
      const float value = weight(from, to);
      std::uint32_t bits = 0;
      std::memcpy(&bits, &value, sizeof bits); // floats that are not negative sort as their bits do
      part.push_back({bits, static_cast<Index>(slot)});
    }
  });
  std::vector<KeyedIndex> items;
  for (std::vector<KeyedIndex>& part : parts) {
    items.insert(items.end(), part.begin(), part.end());
    std::vector<KeyedIndex>().swap(part);
  }
  radixSort(items, 32, options_.threads);
  std::vector<Edge> edges(items.size());
  parallelFor(items.size(), GRAIN, options_.threads, [&](std::size_t e) {
    const auto slot = static_cast<std::size_t>(items[e].index);
    const std::size_t from = slot / width_;
    const Index to = neighbors_[slot];
    edges[e] = {static_cast<Index>(from), to,
                normals_[from].dot(normals_[static_cast<std::size_t>(to)]) < 0.0};
  });
  return edges;
}

} // namespace graben::detail
