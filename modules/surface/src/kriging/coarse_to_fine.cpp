#include "coarse_to_fine.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

namespace graben::detail {

namespace {

constexpr double kTurned = 0.5;       // least cosine between the normals of places that tell of one another
constexpr double kInclusive = 1.0 + 1e-9;
constexpr double kWaysAround = 0.75;  // times the root of how many are wanted: within so many ways there are about as many
constexpr double kFarther = 1.5;
constexpr double kLeastRadius = 1e-3; // of the extent
constexpr std::size_t kFirst = 64;

} // namespace

CoarseToFine::CoarseToFine(Points places, Points normals) : places_(std::move(places)), normals_(std::move(normals)) {
  extent_ = boundsOf(places_, 1).diagonal();
  arrange();
}

void CoarseToFine::arrange() {
  if (places_.empty())
    return;
  const NeighborGrid grid(places_, 0.0, 1);
  std::vector<double> squared(places_.size(), std::numeric_limits<double>::infinity());
  using Far = std::pair<double, std::size_t>; // squared way, and which
  const auto later = [](const Far& a, const Far& b) { return a.first < b.first || (a.first == b.first && a.second > b.second); };
  std::priority_queue<Far, std::vector<Far>, decltype(later)> open(later);
  open.emplace(std::numeric_limits<double>::infinity(), 0);
  PointsAround around;
  while (!open.empty()) {
    const auto [way, next] = open.top();
    open.pop();
    if (way != squared[next])
      continue;
    order_.push_back(next);
    way_.push_back(std::min(std::sqrt(way), extent_));
    squared[next] = -1.0;
    grid.collectWithin(places_[next], kInclusive * std::min(std::sqrt(way), extent_), around);
    for (std::size_t i = 0; i < around.count; ++i) {
      const auto other = static_cast<std::size_t>(around.index[i]);
      if (around.squared_distance[i] < squared[other]) {
        squared[other] = around.squared_distance[i];
        open.emplace(squared[other], other);
      }
    }
  }
}

const std::vector<std::size_t>& CoarseToFine::nearestBefore(std::size_t at, std::size_t most) {
  takeIn(at);
  double radius = std::max(kWaysAround * std::sqrt(static_cast<double>(most)) * way_[at], kLeastRadius * extent_);
  collect(at, radius);
  while (found_.size() < most && radius < extent_)
    collect(at, radius *= kFarther);
  const auto end = found_.begin() + static_cast<std::ptrdiff_t>(std::min(found_.size(), most));
  std::nth_element(found_.begin(), end, found_.end());
  std::sort(found_.begin(), end);
  nearest_.clear();
  for (auto it = found_.begin(); it != end; ++it)
    nearest_.push_back(it->second);
  return nearest_;
}

void CoarseToFine::takeIn(std::size_t at) {
  if (at < first_.size())
    return;
  first_.clear();
  for (std::size_t i = 0; i < std::min(order_.size(), std::max(kFirst, 2 * at)); ++i)
    first_.push_back(places_[order_[i]]);
  grid_ = NeighborGrid(first_, 0.0, 1);
}

void CoarseToFine::collect(std::size_t at, double radius) {
  const std::size_t own = order_[at];
  grid_.collectWithin(places_[own], kInclusive * radius, around_);
  found_.clear();
  for (std::size_t i = 0; i < around_.count; ++i) {
    const auto rank = static_cast<std::size_t>(around_.index[i]);
    if (rank < at && normals_[order_[rank]].dot(normals_[own]) > kTurned)
      found_.emplace_back(around_.squared_distance[i], order_[rank]);
  }
}

} // namespace graben::detail
