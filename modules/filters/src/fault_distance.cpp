#include "graben/filters/fault_distance.h"

#include "graben/core/errors.h"
#include "graben/core/threads.h"

#include <algorithm>
#include <cmath>

namespace graben {

namespace {

/// Looks for points near faults in a block, and where a fault is near in its parts.
class BlockSearch {
public:
  BlockSearch(const Points& points, const FaultNetwork& faults, double limit, const std::vector<Index>* order)
      : points_(points)
      , faults_(faults)
      , limit_(limit)
      , order_(order) {}

  /// Calls near(pick, bound) for the points of [begin, end) that may be near, the bound being no less than the smaller of the limit and their distance,
  /// and within(pick) for those that are within the limit for sure.
  template <typename Near, typename Within>
  void look(std::size_t begin, std::size_t end, const Near& near, const Within& within) const {
    constexpr std::size_t kParts = 8, kFewest = 16;
    const Bounds box = boxOf(begin, end);
    if (box.empty())
      return;
    const double radius = 0.5 * box.diagonal();
    FaultPoint nearest;
    if (std::isfinite(radius * radius)) {
      nearest = faults_.nearest(0.5 * box.low + 0.5 * box.high, kRoundedUp * (limit_ + radius));
      if (nearest.fault < 0)
        return;
      if (kRoundedUp * (nearest.distance + radius) <= limit_)
        return forEach(begin, end, within);
    }
    if (end - begin <= kFewest)
      return forEach(begin, end, [&](std::size_t pick) { near(pick, boundOf(points_[pick], nearest)); });
    const std::size_t part = (end - begin + kParts - 1) / kParts;
    for (std::size_t at = begin; at < end; at += part)
      look(at, std::min(end, at + part), near, within);
  }

private:
  static constexpr double kRoundedUp = 1.0 + 1e-9, kRounding = 1e-12;

  std::size_t pick(std::size_t i) const { return order_ != nullptr ? static_cast<std::size_t>((*order_)[i]) : i; }

  /// No less than the smaller of the limit and a point's distance to the faults. \param[in] any a point of a fault, or none
  double boundOf(const Vector3& p, const FaultPoint& any) const {
    if (any.fault < 0)
      return limit_;
    return std::min(limit_, kRoundedUp * (p - any.point).norm() + kRounding * p.cwiseAbs().maxCoeff());
  }

  /// Of the finite points at least; coordinates that are not numbers are passed over.
  Bounds boxOf(std::size_t begin, std::size_t end) const {
    Bounds box;
    for (std::size_t i = begin; i < end; ++i) {
      const Vector3& p = points_[pick(i)];
      for (int axis = 0; axis < 3; ++axis) {
        box.low[axis] = p[axis] < box.low[axis] ? p[axis] : box.low[axis];
        box.high[axis] = p[axis] > box.high[axis] ? p[axis] : box.high[axis];
      }
    }
    return box;
  }

  template <typename Visit>
  void forEach(std::size_t begin, std::size_t end, const Visit& visit) const {
    for (std::size_t i = begin; i < end; ++i)
      if (points_[pick(i)].allFinite())
        visit(pick(i));
  }

  const Points& points_;
  const FaultNetwork& faults_;
  double limit_;
  const std::vector<Index>* order_;
};

constexpr std::size_t kGrain = 2048;

void checkLimit(double limit) {
  if (!(limit >= 0.0))
    throw InvalidInputError("finding picks near faults", "The width must be zero or positive, in the picks' units.");
}

} // namespace

std::vector<PickNearFault> picksNearFaults(const Points& points, const FaultNetwork& faults, double limit, const std::vector<Index>* order,
                                           unsigned threads) {
  checkLimit(limit);
  const BlockSearch search(points, faults, limit, order);
  return joinBlocks<PickNearFault>(order != nullptr ? order->size() : points.size(), kGrain, threads,
                               [&](std::size_t begin, std::size_t end, std::vector<PickNearFault>& found) {
                                 const auto measure = [&](std::size_t pick, double bound) {
                                   const FaultPoint nearest = faults.nearest(points[pick], bound);
                                   if (nearest.fault >= 0)
                                     found.push_back({static_cast<Index>(pick), nearest.distance});
                                 };
                                 search.look(begin, end, measure, [&](std::size_t pick) { measure(pick, limit); });
                               });
}

std::vector<Index> picksWithin(const Points& points, const FaultNetwork& faults, double limit, unsigned threads) {
  checkLimit(limit);
  const BlockSearch search(points, faults, limit, nullptr);
  return joinBlocks<Index>(points.size(), kGrain, threads, [&](std::size_t begin, std::size_t end, std::vector<Index>& found) {
    const auto take = [&](std::size_t pick) { found.push_back(static_cast<Index>(pick)); };
    const auto measure = [&](std::size_t pick, double bound) {
      if (bound < limit || faults.nearest(points[pick], limit).fault >= 0)
        take(pick);
    };
    search.look(begin, end, measure, take);
  });
}

std::vector<double> distancesToFaults(const Points& points, const FaultNetwork& faults, double limit, unsigned threads) {
  std::vector<double> distances(points.size(), std::numeric_limits<double>::infinity());
  for (const PickNearFault& near : picksNearFaults(points, faults, limit, nullptr, threads))
    distances[static_cast<std::size_t>(near.pick)] = near.distance;
  return distances;
}

} // namespace graben
