#include "lofting/fault_parts.h"

#include "lofting/smooth_loft.h"
#include "lofting/sticks.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace graben::detail {
namespace {

constexpr double kApart = 2.0;      // a gap between faults against how much the sticks of either spread, at least
constexpr double kApartShare = 0.05; // of a stick's length: the least gap
constexpr double kFacing = 0.5;     // of the distance of sticks along strike: how far apart two that face each other may be
constexpr double kLongLink = 2.0;   // usual distances between sticks: a link to another fault is longer
constexpr double kTurnedLink = 0.7; // cosine of the angle by which it is turned, at most
constexpr double kSmooth = 0.85;    // cosine of the usual angle between links, at least, for one to stand out

constexpr double kNoWayRound = 0.7; // of such a link: how near other sticks of the two faults may be to each other

using Group = std::vector<std::size_t>;

Vector3 middleOf(const Points& points) {
  Vector3 sum = Vector3::Zero();
  for (const Vector3& p : points)
    sum += p / static_cast<double>(points.size());
  return sum;
}

double spread(const std::vector<Vector3>& middles, Group::const_iterator begin, Group::const_iterator end) {
  return middles[*(end - 1)].z() - middles[*begin].z();
}

/// How many of some sticks have one of others beside them, across the fault.
std::size_t facing(const std::vector<Vector3>& middles, const Group& some, const Group& others) {
  std::vector<double> at;
  for (const std::size_t i : others)
    at.push_back(middles[i].x());
  std::sort(at.begin(), at.end());
  std::vector<double> steps;
  for (std::size_t i = 0; i + 1 < at.size(); ++i)
    steps.push_back(at[i + 1] - at[i]);
  const double reach = kFacing * median(steps);
  return static_cast<std::size_t>(std::count_if(some.begin(), some.end(), [&](std::size_t i) {
    const auto next = std::lower_bound(at.begin(), at.end(), middles[i].x() - reach);
    return next != at.end() && *next < middles[i].x() + reach;
  }));
}

/// Two faults beside each other: sticks in two sheets, most of them with one of the other sheet on the same section.
std::vector<Group> sheets(const std::vector<FaultStick>& sticks) {
  Group all(sticks.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  if (sticks.size() < 4)
    return {all};
  const FramedSticks framed(sticks);
  std::vector<Vector3> middles;
  std::vector<double> lengths;
  for (const Points& line : framed.lines) {
    middles.push_back(middleOf(line));
    lengths.push_back((line.back() - line.front()).norm());
  }
  Group order = all;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return middles[a].z() < middles[b].z(); });
  std::size_t cut = 0;
  double widest = 0.0;
  for (std::size_t k = 2; k + 2 <= order.size(); ++k) {
    const double gap = middles[order[k]].z() - middles[order[k - 1]].z();
    if (gap > widest) {
      widest = gap;
      cut = k;
    }
  }
  const auto middle = order.begin() + static_cast<std::ptrdiff_t>(cut);
  if (cut == 0 || widest < kApartShare * median(lengths) ||
      widest < kApart * std::max(spread(middles, order.begin(), middle), spread(middles, middle, order.end())))
    return {all};
  std::vector<Group> groups{{order.begin(), middle}, {middle, order.end()}};
  const Group& fewer = groups[0].size() < groups[1].size() ? groups[0] : groups[1];
  const Group& more = groups[0].size() < groups[1].size() ? groups[1] : groups[0];
  if (2 * facing(middles, fewer, more) < fewer.size())
    return {all};
  for (Group& group : groups)
    std::sort(group.begin(), group.end());
  return groups;
}

/// Faults apart: along the path through the sticks, a long link that runs in a plane of its own.
std::vector<Group> stretches(const std::vector<FaultStick>& sticks) {
  const StickOrder order = orderSticks(sticks);
  const std::size_t n = order.order.size();
  std::vector<Vector3> normals;
  std::vector<double> lengths;
  for (std::size_t k = 0; k + 1 < n; ++k) {
    const Points& a = sticks[order.order[k]].points;
    const Points& b = sticks[order.order[k + 1]].points;
    Vector3 run = a.back() - a.front();
    Vector3 next = b.back() - b.front();
    if (order.reversed[order.order[k]])
      run = -run;
    if (order.reversed[order.order[k + 1]])
      next = -next;
    const Vector3 link = middleOf(b) - middleOf(a);
    normals.push_back((run.normalized() + next.normalized()).cross(link).normalized());
    lengths.push_back(link.norm());
  }
  Points middles;
  for (const std::size_t i : order.order)
    middles.push_back(middleOf(sticks[i].points));
  const double usual = median(lengths);
  const auto nearest = [&middles](std::size_t k) { // between the sticks up to the k-th and those after it
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i <= k; ++i)
      for (std::size_t j = k + 1; j < middles.size(); ++j)
        least = std::min(least, (middles[i] - middles[j]).squaredNorm());
    return std::sqrt(least);
  };
  const auto turned = [&](std::size_t k, std::size_t other) { return std::abs(normals[k].dot(normals[other])) < kTurnedLink; };
  std::vector<double> cosines;
  for (std::size_t k = 0; k + 1 < normals.size(); ++k)
    cosines.push_back(std::abs(normals[k].dot(normals[k + 1])));
  const bool smooth = median(cosines) > kSmooth;
  std::vector<Group> groups(1);
  for (std::size_t k = 0; k < n; ++k) {
    groups.back().push_back(order.order[k]);
    const bool inner = smooth && k >= 1 && k + 1 < normals.size();
    if (inner && lengths[k] > kLongLink * usual && turned(k, k - 1) && turned(k, k + 1) && nearest(k) > kNoWayRound * lengths[k])
      groups.emplace_back();
  }
  return groups;
}

std::vector<FaultStick> of(const std::vector<FaultStick>& sticks, const Group& group) {
  std::vector<FaultStick> result;
  for (const std::size_t i : group)
    result.push_back(sticks[i]);
  return result;
}

} // namespace

std::vector<std::vector<FaultStick>> toldApart(const std::vector<FaultStick>& sticks) {
  std::vector<std::vector<FaultStick>> faults;
  for (const Group& sheet : sheets(sticks)) {
    const std::vector<FaultStick> beside = of(sticks, sheet);
    for (Group& stretch : stretches(beside)) {
      std::sort(stretch.begin(), stretch.end());
      faults.push_back(of(beside, stretch));
    }
  }
  return faults;
}

} // namespace graben::detail
