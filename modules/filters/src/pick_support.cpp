#include "pick_support.h"

#include "graben/faults/fault_signature.h"

#include <algorithm>
#include <cmath>

namespace graben::detail {
namespace {

constexpr std::size_t WANTED = 16;      ///< picks a plane is fitted to, as a rule
constexpr std::size_t MOST = 48;        ///< where they are far away
constexpr double SPREAD = 1.6;          ///< farthest over nearest of those wanted, then
constexpr std::size_t NEEDED = 6;       ///< fewest of them
constexpr std::size_t CANDIDATES = 1024; ///< most picks looked at
constexpr double RADIUS = 12.0;          ///< farthest pick, in mean distances
constexpr double SUSPECT_RADIUS = 4.0;  ///< the same among suspects

} // namespace

int faultBetween(const FaultNetwork& faults, const Vector3& a, const Vector3& b) {
  int between = NO_FAULT;
  Bounds box;
  box.extend(a);
  box.extend(b);
  for (std::size_t f = 0; f < faults.size(); ++f) {
    if (!faults.bvh(f).bounds().overlaps(box) || !faults.bvh(f).hits(a, b) ||
        faults.crossings(f, a, b).size() % 2 == 0)
      continue;
    if (between != NO_FAULT)
      return SEVERAL_FAULTS;
    between = static_cast<int>(f);
  }
  return between;
}

/// \param[in] weightOf weight of a candidate, 0 to leave it out
template <typename Select>
PlaneAt PickSupport::plane(const Vector3& viewpoint, double radius, const Select& weightOf) {
  chosen_.clear();
  double nearest = 0.0, farthest = 0.0;
  const auto enough = [&] {
    return chosen_.size() >= MOST || (chosen_.size() >= WANTED && farthest >= SPREAD * nearest);
  };
  // Most queries find enough among few; the long list is for places that faults hem in.
  std::size_t seen = 0;
  for (std::size_t count = CANDIDATES / 16; !enough() && count <= CANDIDATES; count *= 4) {
    field_.grid.nearest(viewpoint, count, candidates_, radius);
    for (; seen < candidates_.size() && !enough(); ++seen) {
      const Neighbor& c = candidates_[seen];
      const double weight = weightOf(static_cast<std::size_t>(c.index));
      if (!(weight > 0.0))
        continue;
      chosen_.push_back({field_.grid.points()[static_cast<std::size_t>(c.index)], weight});
      farthest = std::sqrt(c.squared_distance);
      if (chosen_.size() == 1)
        nearest = farthest;
    }
    if (candidates_.size() < count)
      break;
  }
  if (chosen_.size() < NEEDED)
    return {};
  for (WeightedPoint& p : chosen_) {
    const double share = (p.position - viewpoint).norm() / (1.5 * farthest);
    p.weight *= (1.0 - share * share) * (1.0 - share * share);
  }
  return robustPlaneAt(viewpoint, chosen_, field_.scale);
}

PlaneAt PickSupport::ownPlane(const Vector3& viewpoint) {
  return plane(viewpoint, RADIUS * field_.mean_distance, [&](std::size_t i) {
    return field_.states[i] == PickState::Trusted &&
                   sameSide(field_.faults, viewpoint, field_.grid.points()[i])
               ? 1.0
               : 0.0;
  });
}

PlaneAt PickSupport::suspectPlane(const Vector3& viewpoint) {
  return plane(viewpoint, SUSPECT_RADIUS * field_.mean_distance, [&](std::size_t i) {
    return field_.states[i] == PickState::Suspect &&
                   sameSide(field_.faults, viewpoint, field_.grid.points()[i])
               ? 1.0
               : 0.0;
  });
}

PlaneAt PickSupport::consensusPlane(const Vector3& viewpoint) {
  return plane(viewpoint, RADIUS * field_.mean_distance, [&](std::size_t i) {
    const bool trusted = field_.states[i] == PickState::Trusted;
    if ((!trusted && field_.states[i] != PickState::Pending) ||
        !sameSide(field_.faults, viewpoint, field_.grid.points()[i]))
      return 0.0;
    const double far = std::min(1.0, 0.25 * field_.distances[i] / field_.mean_distance);
    return trusted ? 1.0 : far * far;
  });
}

PlaneAt PickSupport::planeBeyond(std::size_t fault, const Vector3& viewpoint) {
  const int wanted = static_cast<int>(fault);
  return plane(viewpoint, RADIUS * field_.mean_distance, [&](std::size_t i) {
    const bool trusted = field_.states[i] == PickState::Trusted;
    const bool like_it =
        field_.states[i] == PickState::WrongSide && field_.wrong_about[i] == wanted;
    if (!trusted && !like_it)
      return 0.0;
    const int between = faultBetween(field_.faults, viewpoint, field_.grid.points()[i]);
    return between == (trusted ? wanted : NO_FAULT) ? 1.0 : 0.0;
  });
}

PlaneAt PickSupport::planeBeside(const Vector3& query, const Vector3& direction, double gap,
                                 double radius) {
  return plane(query, radius, [&](std::size_t i) {
    return (field_.grid.points()[i] - query).dot(direction) >= gap ? 1.0 : 0.0;
  });
}

} // namespace graben::detail
