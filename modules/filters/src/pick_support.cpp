#include "pick_support.h"

#include "graben/faults/fault_signature.h"

#include <algorithm>
#include <cmath>

namespace graben::detail {
namespace {

constexpr std::size_t WANTED = 16;                 ///< picks a plane is fitted to, as a rule
constexpr std::size_t MOST = 48;                   ///< where they are far away
constexpr double SPREAD = 1.6;                     ///< farthest over nearest of those wanted, then
constexpr std::size_t NEEDED = 6;                  ///< fewest of them
constexpr std::size_t CROWD = 8192, CANDIDATES = 1024; ///< of more picks than the first no more than the second are looked at
constexpr double RADIUS = 12.0;                    ///< farthest pick, in mean distances
constexpr double FIRST_RADIUS = 4.5;               ///< that most queries find enough within
constexpr double SUSPECT_RADIUS = 4.0;             ///< the same among suspects
constexpr std::size_t HIDDEN = 400;                ///< picks beyond faults to look at
constexpr std::size_t SHEETS = 6;                  ///< most sheets told apart there

/// True if the points so far, nearest first, make a plane that needs no more.
bool enough(const std::vector<WeightedPoint>& points, const Vector3& viewpoint) {
  if (points.size() < WANTED || points.size() >= MOST)
    return points.size() >= MOST;
  return (points.back().position - viewpoint).norm() >=
         SPREAD * (points.front().position - viewpoint).norm();
}

/// \param[in] points nearest first; their weights are lowered with distance
PlaneAt fit(std::vector<WeightedPoint>& points, const Vector3& viewpoint, double scale) {
  if (points.size() < NEEDED)
    return {};
  const double limit = 1.5 * (points.back().position - viewpoint).norm();
  for (WeightedPoint& p : points) {
    const double share = (p.position - viewpoint).norm() / limit;
    p.weight *= (1.0 - share * share) * (1.0 - share * share);
  }
  return robustPlaneAt(viewpoint, points, scale);
}

} // namespace

/// Signature of the faults between a viewpoint and a pick. There is none where the two balls that hold no fault touch.
std::uint64_t PickSupport::faultsBefore(const Viewpoint& viewpoint, std::size_t pick) const {
  constexpr double kRounding = 1.0 - 1e-9;
  const Vector3& p = field_.grid.points()[pick];
  const double clear = kRounding * (viewpoint.clearance + std::min(field_.distances[pick], field_.band));
  return (p - viewpoint.at).squaredNorm() < clear * clear ? 0 : faultSignature(field_.faults, viewpoint.at, p);
}

/// Fills candidates_ with the picks within \a radius that have a weight, nearest first; in a crowd only with the nearest.
template <typename Weigh>
void PickSupport::collect(const Vector3& place, double radius, const Weigh& weightOf) {
  candidates_.clear();
  field_.grid.runsAround(place, radius, runs_);
  std::size_t count = 0;
  for (const PointRun& run : runs_)
    count += run.count;
  if (count > CROWD) {
    field_.grid.nearest(place, CANDIDATES, candidates_, radius);
    const auto has_none = [&](const Neighbor& c) { return weightOf(static_cast<std::size_t>(c.index)) == 0.0; };
    candidates_.erase(std::remove_if(candidates_.begin(), candidates_.end(), has_none), candidates_.end());
    return;
  }
  candidates_.resize(count);
  Neighbor* candidates = candidates_.data();
  std::size_t found = 0;
  for (const PointRun& run : runs_)
    for (std::size_t i = 0; i < run.count; ++i) { // without a branch: about every second pick is one
      candidates[found] = {run.index(i), (run.points[i] - place).squaredNorm()};
      const bool within = candidates[found].squared_distance <= radius * radius, weighs = weightOf(static_cast<std::size_t>(run.index(i))) > 0.0;
      found += within && weighs ? 1 : 0;
    }
  candidates_.resize(found);
  std::sort(candidates_.begin(), candidates_.end(), [](const Neighbor& a, const Neighbor& b) {
    return a.squared_distance != b.squared_distance ? a.squared_distance < b.squared_distance : a.index < b.index;
  });
}

/// Through picks that no fault hides. \param[in] weightOf weight of a pick, 0 to leave it out
template <typename Weigh>
PlaneAt PickSupport::plane(const Viewpoint& viewpoint, double radius, const Weigh& weightOf) {
  chosen_.clear();
  std::size_t seen = 0;
  for (double reach = std::min(radius, FIRST_RADIUS * field_.mean_distance);; reach = std::min(radius, 2.0 * reach)) {
    collect(viewpoint.at, reach, weightOf);
    for (; seen < candidates_.size() && !enough(chosen_, viewpoint.at); ++seen) {
      const auto i = static_cast<std::size_t>(candidates_[seen].index);
      if (faultsBefore(viewpoint, i) == 0)
        chosen_.push_back({field_.grid.points()[i], weightOf(i)});
    }
    if (reach >= radius || enough(chosen_, viewpoint.at))
      break;
  }
  return fit(chosen_, viewpoint.at, field_.scale);
}

PlaneAt PickSupport::ownPlane(const Viewpoint& viewpoint) {
  return plane(viewpoint, RADIUS * field_.mean_distance, [&](std::size_t i) { return field_.states[i] == PickState::Trusted ? 1.0 : 0.0; });
}

PlaneAt PickSupport::suspectPlane(const Viewpoint& viewpoint) {
  return plane(viewpoint, SUSPECT_RADIUS * field_.mean_distance, [&](std::size_t i) { return field_.states[i] == PickState::Suspect ? 1.0 : 0.0; });
}

PlaneAt PickSupport::consensusPlane(const Viewpoint& viewpoint) {
  return plane(viewpoint, RADIUS * field_.mean_distance, [&](std::size_t i) {
    if (field_.states[i] == PickState::Trusted)
      return 1.0;
    const double far = std::min(1.0, 0.25 * field_.distances[i] / field_.mean_distance);
    return field_.states[i] == PickState::Pending ? far * far : 0.0;
  });
}

PlaneAt PickSupport::planeBeside(const Viewpoint& query, const Vector3& direction, double gap,
                                 double radius) {
  return plane(query, radius, [&](std::size_t i) { return (field_.grid.points()[i] - query.at).dot(direction) >= gap ? 1.0 : 0.0; });
}

std::vector<SheetBeyond> PickSupport::sheetsBeyond(const Viewpoint& viewpoint) {
  std::vector<SheetBeyond> sheets;
  std::vector<std::vector<WeightedPoint>> points;
  std::size_t hidden = 0;
  collect(viewpoint.at, RADIUS * field_.mean_distance, [&](std::size_t i) {
    return field_.states[i] == PickState::Trusted || field_.states[i] == PickState::WrongSide ? 1.0 : 0.0;
  });
  for (const Neighbor& c : candidates_) {
    const auto i = static_cast<std::size_t>(c.index);
    const Vector3& p = field_.grid.points()[i];
    const Home home = field_.home(i);
    const std::uint64_t signature = faultsBefore(viewpoint, i) ^ home.signature;
    if (signature == 0)
      continue;
    std::size_t s = 0;
    while (s < sheets.size() && sheets[s].signature != signature)
      ++s;
    if (s == SHEETS || ++hidden > HIDDEN)
      continue;
    if (s == sheets.size()) {
      sheets.push_back({signature, home.example, {}});
      points.emplace_back();
    }
    if (!enough(points[s], viewpoint.at))
      points[s].push_back({p, 1.0});
  }
  for (std::size_t s = 0; s < sheets.size(); ++s)
    sheets[s].plane = fit(points[s], viewpoint.at, field_.scale);
  return sheets;
}

} // namespace graben::detail
