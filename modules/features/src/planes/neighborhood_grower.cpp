#include "planes/neighborhood_grower.h"

#include <algorithm>
#include <cmath>

namespace graben::detail {
namespace {

// Candidates asked for, in multiples of K, where not all of the K nearest join.
constexpr std::size_t FIRST_FACTOR = 3, LAST_FACTOR = 27;
constexpr std::size_t ANCHORS = 4;

double noneIfZero(double limit) {
  return limit > 0.0 ? limit : std::numeric_limits<double>::infinity();
}

} // namespace

NeighborhoodGrower::NeighborhoodGrower(const NeighborGrid& grid, const FaultNetwork& faults,
                                       const TangentPlaneOptions& options)
    : grid_(grid)
    , points_(grid.points())
    , faults_(faults)
    , wanted_(std::max<std::size_t>(options.neighbors, 3))
    , step_(noneIfZero(options.rho_plus_delta))
    , squared_step_(step_ * step_)
    , max_distance_(noneIfZero(options.max_distance)) {}

/// False if number \a i of those found repeats the place of an earlier one.
bool NeighborhoodGrower::isFirstAtItsPlace(std::size_t i) const {
  for (std::size_t other = i; other-- > 0 && found_[other].squared_distance == found_[i].squared_distance;)
    if (points_[static_cast<std::size_t>(found_[other].index)] == points_[static_cast<std::size_t>(found_[i].index)])
      return false;
  return true;
}

/// The common case: the K nearest are all within a step of the pick itself and no fault is near. False if not so.
bool NeighborhoodGrower::takeNearest(std::vector<Index>& neighbors) {
  if (pick_ < 0)
    return false;
  grid_.nearest(place_, wanted_, found_, max_distance_);
  if (found_.size() < wanted_ || found_.front().index != pick_ || !(found_.back().squared_distance < squared_step_))
    return false;
  if (!faults_.empty()) {
    const Vector3 reach = Vector3::Constant(std::sqrt(found_.back().squared_distance));
    Bounds box;
    box.extend(place_ - reach);
    box.extend(place_ + reach);
    near_fault_ = faults_.mayTouch(box);
    if (near_fault_)
      return false;
  }
  neighbors.resize(wanted_);
  for (std::size_t i = 0; i < wanted_; ++i) {
    if (i > 0 && found_[i].squared_distance == found_[i - 1].squared_distance && !isFirstAtItsPlace(i))
      return false;
    neighbors[i] = found_[i].index;
  }
  return true;
}

/// Fills candidates_ from the \a count nearest points; false if that gives fewer than K - 1
/// distinct ones although there may be more.
bool NeighborhoodGrower::queryCandidates(std::size_t count) {
  grid_.nearest(place_, count, found_, max_distance_);
  all_queried_ = found_.size() < count || found_.size() == grid_.size();
  candidates_.clear();
  Bounds box;
  box.extend(place_);
  for (const Neighbor& neighbor : found_) {
    if (neighbor.squared_distance == 0.0) {
      if (pick_ < 0)
        pick_ = neighbor.index;
      continue;
    }
    const Vector3& q = points_[static_cast<std::size_t>(neighbor.index)];
    bool repeated = false;
    for (auto other = candidates_.rbegin();
         other != candidates_.rend() && other->squared_distance == neighbor.squared_distance;
         ++other)
      repeated = repeated || points_[static_cast<std::size_t>(other->index)] == q;
    if (repeated)
      continue;
    box.extend(q);
    candidates_.push_back(
        {neighbor.index, neighbor.squared_distance, neighbor.squared_distance, true});
  }
  near_fault_ = !faults_.empty() && faults_.mayTouch(box);
  return candidates_.size() + 1 >= wanted_ || all_queried_;
}

bool NeighborhoodGrower::stepsInto(const Vector3& point,
                                   const std::vector<Index>& neighbors) const {
  return std::any_of(neighbors.begin(), neighbors.end(), [&](Index n) {
    return (points_[static_cast<std::size_t>(n)] - point).squaredNorm() < squared_step_;
  });
}

/// The common case: no fault near, and every candidate may join when its turn comes. False if not
/// so.
void NeighborhoodGrower::start(std::vector<Index>& neighbors) const {
  neighbors.clear();
  if (pick_ >= 0)
    neighbors.push_back(pick_);
}

bool NeighborhoodGrower::growInOrder(std::vector<Index>& neighbors) const {
  if (near_fault_ || candidates_.size() + 1 < wanted_)
    return false;
  start(neighbors);
  for (std::size_t i = 0; i < candidates_.size() && neighbors.size() < wanted_; ++i) {
    const Candidate& candidate = candidates_[i];
    if (candidate.squared_distance >= squared_step_ &&
        !stepsInto(points_[static_cast<std::size_t>(candidate.index)], neighbors))
      return false;
    neighbors.push_back(candidate.index);
  }
  return true;
}

void NeighborhoodGrower::join(Candidate& candidate, std::vector<Index>& neighbors) {
  candidate.open = false;
  neighbors.push_back(candidate.index);
  const Vector3& q = points_[static_cast<std::size_t>(candidate.index)];
  for (Candidate& other : candidates_)
    if (other.open && other.squared_step >= squared_step_)
      other.squared_step = std::min(
          other.squared_step, (points_[static_cast<std::size_t>(other.index)] - q).squaredNorm());
}

/// Joins, time after time, the candidate nearest to the pick that is a step away and not across a
/// fault as seen from the anchor.
void NeighborhoodGrower::growByRounds(const Vector3& anchor, std::vector<Index>& neighbors) {
  start(neighbors);
  blocked_ = false;
  for (Candidate& candidate : candidates_) {
    candidate.open = true;
    candidate.squared_step = candidate.squared_distance;
  }
  for (std::size_t i = 0; i < candidates_.size() && neighbors.size() < wanted_; ++i) {
    Candidate& candidate = candidates_[i];
    if (!candidate.open || candidate.squared_step >= squared_step_)
      continue;
    if (near_fault_ &&
        faults_.crosses(anchor, points_[static_cast<std::size_t>(candidate.index)])) {
      candidate.open = false;
      blocked_ = true;
      continue;
    }
    join(candidate, neighbors);
    // The new neighbour may have brought an earlier candidate within a step.
    for (std::size_t earlier = 0; earlier < i; ++earlier)
      if (candidates_[earlier].open && candidates_[earlier].squared_step < squared_step_) {
        i = earlier - 1; // wraps to the one before the first; the loop's ++i brings it back
        break;
      }
  }
}

/// Whether points beyond the candidates could still join.
bool NeighborhoodGrower::mayGrowFurther(const std::vector<Index>& neighbors) const {
  if (neighbors.size() >= wanted_ || all_queried_ || candidates_.empty())
    return false;
  if (std::isinf(step_))
    return true;
  double reach = 0.0;
  for (const Index n : neighbors)
    reach = std::max(reach, (points_[static_cast<std::size_t>(n)] - place_).norm());
  return std::sqrt(candidates_.back().squared_distance) < reach + step_;
}

void NeighborhoodGrower::grow(Index pick, std::vector<Index>& neighbors) {
  pick_ = pick;
  place_ = points_[static_cast<std::size_t>(pick)];
  growFromHere(neighbors);
}

void NeighborhoodGrower::growAt(const Vector3& place, std::vector<Index>& neighbors) {
  pick_ = -1;
  place_ = place;
  growFromHere(neighbors);
}

void NeighborhoodGrower::growFromHere(std::vector<Index>& neighbors) {
  neighbors.clear();
  if (!place_.allFinite())
    return;
  near_fault_ = false;
  if (takeNearest(neighbors) || (!near_fault_ && queryCandidates(wanted_) && growInOrder(neighbors)))
    return;
  for (std::size_t factor = FIRST_FACTOR;; factor *= 3) {
    const bool enough = queryCandidates(factor * wanted_);
    if (!enough && factor < LAST_FACTOR)
      continue;
    growByRounds(place_, neighbors);
    // A pick on a fault sees nothing; it takes the side of the nearest pick that does.
    const std::size_t anchors = blocked_ ? std::min(ANCHORS, candidates_.size()) : 0;
    for (std::size_t a = 0; a < anchors && neighbors.size() < 3; ++a)
      growByRounds(points_[static_cast<std::size_t>(candidates_[a].index)], neighbors);
    const bool plenty = neighbors.size() >= wanted_ / 2 && neighbors.size() >= 6;
    if (factor >= LAST_FACTOR || plenty || !mayGrowFurther(neighbors))
      return;
  }
}

} // namespace graben::detail
