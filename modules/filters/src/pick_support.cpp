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
constexpr std::size_t FEW = 64, CANDIDATES = 1024; ///< picks looked at, first and at most
constexpr double RADIUS = 12.0;                    ///< farthest pick, in mean distances
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

/// \param[in] weightOf weight of a candidate, 0 to leave it out
template <typename Select>
PlaneAt PickSupport::plane(const Viewpoint& viewpoint, double radius, const Select& weightOf) {
  chosen_.clear();
  // Most queries find enough among few; the long list is for places that faults hem in.
  std::size_t seen = 0;
  for (std::size_t count = FEW; !enough(chosen_, viewpoint.at) && count <= CANDIDATES; count *= 4) {
    field_.grid.nearest(viewpoint.at, count, candidates_, radius);
    for (; seen < candidates_.size() && !enough(chosen_, viewpoint.at); ++seen) {
      const auto i = static_cast<std::size_t>(candidates_[seen].index);
      const double weight = weightOf(i);
      if (weight > 0.0)
        chosen_.push_back({field_.grid.points()[i], weight});
    }
    if (candidates_.size() < count)
      break;
  }
  return fit(chosen_, viewpoint.at, field_.scale);
}

PlaneAt PickSupport::ownPlane(const Viewpoint& viewpoint) {
  return plane(viewpoint, RADIUS * field_.mean_distance, [&](std::size_t i) {
    return field_.states[i] == PickState::Trusted &&
                   sees(viewpoint, i)
               ? 1.0
               : 0.0;
  });
}

PlaneAt PickSupport::suspectPlane(const Viewpoint& viewpoint) {
  return plane(viewpoint, SUSPECT_RADIUS * field_.mean_distance, [&](std::size_t i) {
    return field_.states[i] == PickState::Suspect &&
                   sees(viewpoint, i)
               ? 1.0
               : 0.0;
  });
}

PlaneAt PickSupport::consensusPlane(const Viewpoint& viewpoint) {
  return plane(viewpoint, RADIUS * field_.mean_distance, [&](std::size_t i) {
    const bool trusted = field_.states[i] == PickState::Trusted;
    if ((!trusted && field_.states[i] != PickState::Pending) ||
        !sees(viewpoint, i))
      return 0.0;
    const double far = std::min(1.0, 0.25 * field_.distances[i] / field_.mean_distance);
    return trusted ? 1.0 : far * far;
  });
}

PlaneAt PickSupport::planeBeside(const Viewpoint& query, const Vector3& direction, double gap,
                                 double radius) {
  return plane(query, radius, [&](std::size_t i) {
    const Vector3& p = field_.grid.points()[i];
    return (p - query.at).dot(direction) >= gap && sees(query, i) ? 1.0 : 0.0;
  });
}

std::vector<SheetBeyond> PickSupport::sheetsBeyond(const Viewpoint& viewpoint) {
  std::vector<SheetBeyond> sheets;
  std::vector<std::vector<WeightedPoint>> points;
  std::size_t hidden = 0;
  field_.grid.nearest(viewpoint.at, CANDIDATES, candidates_, RADIUS * field_.mean_distance);
  for (const Neighbor& c : candidates_) {
    const auto i = static_cast<std::size_t>(c.index);
    if (field_.states[i] != PickState::Trusted && field_.states[i] != PickState::WrongSide)
      continue;
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
