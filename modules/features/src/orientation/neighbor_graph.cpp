#include "orientation/neighbor_graph.h"

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
    , longest_(options.rho_plus_delta > 0.0 ? options.rho_plus_delta : std::numeric_limits<double>::infinity())
    , may_look_around_(in_order_ && !options.components && !std::isinf(longest_)) {
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

NeighborGraph::Around NeighborGraph::lookAround(Index begin, Index end, std::vector<PointRun>& runs, std::vector<Index>& nodes) const {
  constexpr double SURE = 0.70711;  // two normals that are closer to a third than 45 degrees agree
  constexpr std::size_t MANY = 16;  // for each node asked about; to look for the neighbours of each is cheaper then
  nodes.clear();
  if (!may_look_around_)
    return Around::Differ;
  Bounds box;
  Index first = end;
  for (Index node = begin; node < end; ++node)
    if (hasNormal(node)) {
      first = std::min(first, node);
      box.extend(pointOf(node));
    }
  if (first == end)
    return Around::Agree;
  const Vector3 centre = 0.5 * (box.low + box.high);
  const double radius = 0.5 * box.diagonal() + longest_;
  box.low.array() -= longest_;
  box.high.array() += longest_;
  if (!faults_.empty() && faults_.mayTouch(box))
    return Around::Differ;
  grid_.runsAround(centre, radius, runs);
  std::size_t count = 0;
  for (const PointRun& run : runs)
    count += run.count;
  if (count > MANY * static_cast<std::size_t>(end - begin))
    return Around::TooMany;
  const Vector3& axis = normals_[pickOf(first)];
  for (const PointRun& run : runs)
    for (std::size_t i = 0; i < run.count; ++i) {
      const Vector3& p = run.points[i];
      const Index node = run.index(i);
      if (!((p.array() >= box.low.array()).all() && (p.array() <= box.high.array()).all()) || !hasNormal(node))
        continue;
      if (std::abs(normals_[pickOf(node)].dot(axis)) < SURE)
        return Around::Differ;
      nodes.push_back(node);
    }
  return Around::Agree;
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
