#include "planes/neighborhood_batch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace graben::detail {
namespace {

constexpr std::size_t MOST_PICKS = 64;
constexpr double WIDTH = 4.0;    // of the picks' box, in cells
constexpr double MARGIN = 1.06;   // of the radius over the neighbourhoods of the picks before
constexpr double WIDER = 1.4;     // where it was too small
constexpr int ATTEMPTS = 3;
constexpr std::size_t MOST_AROUND = 48; // points around for each neighbour wanted: far more than on any surface

double noneIfZero(double limit) {
  return limit > 0.0 ? limit : std::numeric_limits<double>::infinity();
}

std::size_t hashOf(const Vector3& p) {
  std::array<double, 3> place = {p.x() + 0.0, p.y() + 0.0, p.z() + 0.0}; // -0 is where 0 is
  std::array<std::uint64_t, 3> bits{};
  std::memcpy(bits.data(), place.data(), sizeof bits);
  const std::uint64_t hash = (bits[0] ^ bits[1] * 0xc2b2ae3d27d4eb4fULL ^ bits[2] * 0x165667b19e3779f9ULL) * 0x9e3779b97f4a7c15ULL;
  return static_cast<std::size_t>(hash >> 32);
}

} // namespace

NeighborhoodBatch::NeighborhoodBatch(const NeighborGrid& grid, const FaultNetwork& faults, const MeasuredNormals& measured,
                                     const TangentPlaneOptions& options)
    : grid_(grid)
    , points_(grid.points())
    , faults_(faults)
    , measured_(measured)
    , wanted_(options.neighbors - 1)
    , squared_step_(std::pow(noneIfZero(options.rho_plus_delta), 2.0))
    , max_distance_(noneIfZero(options.max_distance)) {}

std::size_t NeighborhoodBatch::extent(const Index* picks, std::size_t count) const {
  const double width = WIDTH * grid_.cellSize();
  Bounds box;
  std::size_t taken = 0;
  for (; taken < std::min(count, MOST_PICKS); ++taken) {
    box.extend(pointOf(picks[taken]));
    if (taken > 0 && box.size().maxCoeff() > width)
      break;
  }
  return taken;
}

void NeighborhoodBatch::find(const Index* picks, std::size_t count) {
  simple_.assign(count, false);
  moments_.resize(count);
  open_.clear();
  for (std::size_t i = 0; i < count; ++i)
    open_.push_back(i);
  if (radius_ == 0.0) {
    std::vector<Neighbor> nearest;
    grid_.nearest(pointOf(picks[0]), wanted_ + 1, nearest);
    radius_ = MARGIN * std::sqrt(nearest.back().squared_distance);
  }
  for (int attempt = 0; attempt < ATTEMPTS && !open_.empty(); ++attempt) {
    radius_ = std::min(radius_, max_distance_);
    Bounds box;
    for (const std::size_t i : open_)
      box.extend(pointOf(picks[i]));
    if (!gather(box))
      return;
    search(picks);
    if (open_.empty() || radius_ == max_distance_)
      break;
    radius_ *= WIDER;
  }
  double reach = 0.0;
  for (std::size_t i = 0; i < count; ++i)
    reach = simple_[i] ? std::max(reach, moments_[i].farthest) : reach;
  if (reach > 0.0)
    radius_ = MARGIN * std::sqrt(reach);
}

/// Sets the different points within the radius of the box; false if they are too many or one of them has a measured normal.
bool NeighborhoodBatch::gather(const Bounds& box) {
  grid_.runsAround(box, radius_, runs_);
  if (grid_.inOrder())
    std::sort(runs_.begin(), runs_.end(), [](const PointRun& a, const PointRun& b) { return a.first < b.first; });
  std::size_t most = 0;
  bool may_repeat = false;
  for (const PointRun& run : runs_) {
    most += run.count;
    may_repeat = may_repeat || run.may_repeat;
  }
  if (most > MOST_AROUND * (wanted_ + MOST_PICKS))
    return false;
  around_.resize(most);
  nearby_.clear();
  std::size_t count = 0;
  for (const PointRun& run : runs_) {
    for (std::size_t i = 0; i < run.count; ++i)
      around_[count++] = run.index(i);
    if (grid_.inOrder() && !may_repeat)
      nearby_.add(run.points->data(), run.count);
  }
  if (!measured_.empty() && std::any_of(around_.begin(), around_.end(), [&](Index i) { return measured_.has(i); }))
    return false;
  if (!grid_.inOrder())
    std::sort(around_.begin(), around_.end());
  if (may_repeat)
    leaveOutRepeated();
  if (!grid_.inOrder() || may_repeat)
    for (const Index i : around_)
      nearby_.add(pointOf(i).data(), 1);
  Bounds reached = box;
  reached.low.array() -= radius_;
  reached.high.array() += radius_;
  markSides(reached);
  return true;
}

/// Tells the points around apart by the faults in a box that holds all that may be found.
void NeighborhoodBatch::markSides(const Bounds& box) {
  slabs_.gather(faults_, box);
  marks_.clear();
  if (slabs_.empty())
    return;
  for (const Index i : around_)
    marks_.push_back(slabs_.mark(pointOf(i)));
}

/// Of the points around at one place keeps the first alone.
void NeighborhoodBatch::leaveOutRepeated() {
  std::size_t slots = 64;
  while (slots < 2 * around_.size())
    slots *= 2;
  places_.assign(slots, -1);
  const auto repeats = [&](Index i) {
    const Vector3& p = pointOf(i);
    std::size_t slot = hashOf(p) & (slots - 1);
    while (places_[slot] >= 0 && pointOf(places_[slot]) != p)
      slot = (slot + 1) & (slots - 1);
    const bool known = places_[slot] >= 0;
    if (!known)
      places_[slot] = i;
    return known;
  };
  around_.erase(std::remove_if(around_.begin(), around_.end(), repeats), around_.end());
}

/// Leaves in open_ the picks that have too few points within the radius.
void NeighborhoodBatch::search(const Index* picks) {
  const double limit = radius_ * radius_;
  std::size_t left = 0;
  for (const std::size_t i : open_) {
    const Vector3& pick = pointOf(picks[i]);
    if (!nearby_.findNearest(pick.data(), wanted_, limit)) {
      open_[left++] = i;
      continue;
    }
    moments_[i] = nearby_.foundMoments();
    simple_[i] = (moments_[i].farthest < squared_step_ || allJoin(pick)) && !(!slabs_.empty() && crossesFault(pick));
  }
  open_.resize(left);
}

/// Whether each of the points found that is farther than a step is a step from one that is not, and so surely joins in its turn.
bool NeighborhoodBatch::allJoin(const Vector3& pick) {
  const std::size_t count = nearby_.foundCount();
  within_step_.resize(count);
  beyond_step_.resize(count);
  std::size_t within = 0, beyond = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Index q = around_[nearby_.found(i)];
    const bool joins = (pointOf(q) - pick).squaredNorm() < squared_step_;
    within_step_[within] = beyond_step_[beyond] = q;
    within += joins ? 1 : 0;
    beyond += joins ? 0 : 1;
  }
  const auto is_step = [&](Index q, Index n) { return (pointOf(n) - pointOf(q)).squaredNorm() < squared_step_; };
  return std::all_of(beyond_step_.data(), beyond_step_.data() + beyond, [&](Index q) {
    return std::any_of(within_step_.data(), within_step_.data() + within, [&](Index n) { return is_step(q, n); });
  });
}

/// Whether a fault lies between a pick and one of the points found for it.
bool NeighborhoodBatch::crossesFault(const Vector3& pick) const {
  const FaultSlabs::Mark own = slabs_.mark(pick);
  FaultSlabs::Mark common = own;
  for (std::size_t i = 0; i < nearby_.foundCount(); ++i)
    common &= marks_[nearby_.found(i)];
  if (slabs_.clear(common))
    return false;
  const auto crosses = [&](std::size_t i) { return faults_.crosses(pick, pointOf(around_[nearby_.found(i)])); };
  for (const bool opposite : {true, false}) // first where a fault is likely
    for (std::size_t i = 0; i < nearby_.foundCount(); ++i) {
      const FaultSlabs::Mark other = marks_[nearby_.found(i)];
      if (!slabs_.clear(own & other) && FaultSlabs::opposite(own, other) == opposite && crosses(i))
        return true;
    }
  return false;
}

} // namespace graben::detail
