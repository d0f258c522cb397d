#include "neighbor_graph.h"

#include "graben/core/threads.h"
#include "graben/mesh/bounds.h"

#include <algorithm>
#include <cmath>

namespace graben::detail {

NeighborGraph::NeighborGraph(const NeighborGrid& grid, const FaultNetwork& faults, const OrientationOptions& options, const Points& normals)
    : grid_(grid)
    , faults_(faults)
    , normals_(normals)
    , in_order_(grid.inOrder())
    , count_(in_order_ ? grid.points().size() : grid.size())
    , width_(std::max<std::size_t>(options.neighbors, 1))
    , longest_(options.rho_plus_delta > 0.0 ? options.rho_plus_delta : std::numeric_limits<double>::infinity()) {
  if (in_order_)
    return;
  position_.assign(grid.points().size(), -1);
  parallelFor(count_, 1 << 14, options.threads,
              [&](std::size_t node) { position_[static_cast<std::size_t>(grid.order()[node])] = static_cast<Index>(node); });
}

float NeighborGraph::weight(Index a, Index b) const {
  return static_cast<float>(std::max(0.0, 1.0 - std::abs(normals_[pickOf(a)].dot(normals_[pickOf(b)]))));
}

void NeighborGraph::neighborsOf(Index node, std::vector<Neighbor>& found, std::vector<Index>& nodes) const {
  nodes.clear();
  if (!hasNormal(node))
    return;
  const auto pick = static_cast<Index>(pickOf(node));
  grid_.nearest(pointOf(node), width_ + 1, found, longest_);
  std::size_t slots = width_;
  for (const Neighbor& neighbor : found) {
    if (neighbor.index == pick || slots == 0)
      continue;
    --slots;
    if (normals_[static_cast<std::size_t>(neighbor.index)].allFinite())
      nodes.push_back(nodeOf(neighbor.index));
  }
  dropCrossing(node, nodes);
}

/// Takes out the neighbours on the other side of a fault.
void NeighborGraph::dropCrossing(Index node, std::vector<Index>& nodes) const {
  if (faults_.empty())
    return;
  Bounds box;
  box.extend(pointOf(node));
  for (const Index other : nodes)
    box.extend(pointOf(other));
  if (!faults_.mayTouch(box))
    return;
  nodes.erase(std::remove_if(nodes.begin(), nodes.end(), [&](Index other) { return faults_.crosses(pointOf(node), pointOf(other)); }),
              nodes.end());
}

} // namespace graben::detail
