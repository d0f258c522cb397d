#include "lofting/sticks.h"
#include "meshes/cleaning.h"

#include "graben/core/errors.h"
#include "graben/faults/fault_surface.h"
#include "graben/mesh/bounds.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace graben {
namespace detail {
namespace {

constexpr double kRepeat = 1e-10;        // of a stick's size: points closer than this are one
constexpr std::size_t kMaxSticks = 3000; // the search along strike holds a distance for every pair

bool before(const Vector3& a, const Vector3& b) {
  return std::tie(a.x(), a.y(), a.z()) < std::tie(b.x(), b.y(), b.z());
}

bool higher(const Vector3& a, const Vector3& b) {
  return a.z() != b.z() ? a.z() > b.z() : before(a, b);
}

} // namespace

double length(const FaultStick& stick) {
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < stick.points.size(); ++i)
    sum += (stick.points[i + 1] - stick.points[i]).norm();
  return sum;
}

bool before(const FaultStick& a, const FaultStick& b) {
  return std::lexicographical_compare(
      a.points.begin(), a.points.end(), b.points.begin(), b.points.end(),
      [](const Vector3& p, const Vector3& q) { return before(p, q); });
}

FaultStick cleanedStick(const FaultStick& stick, bool& reversed) {
  Points finite;
  Bounds box;
  for (const Vector3& p : stick.points)
    if (p.allFinite()) {
      finite.push_back(p);
      box.extend(p);
    }
  reversed = false;
  if (finite.size() < 2)
    return {};
  const double repeat = kRepeat * box.diagonal();
  reversed = higher(finite.back(), finite.front());
  if (reversed)
    std::reverse(finite.begin(), finite.end());
  FaultStick out;
  const std::vector<Index> first = weldMap(finite, repeat);
  for (std::size_t i = 0; i < finite.size(); ++i)
    if (first[i] == static_cast<Index>(i))
      out.points.push_back(finite[i]);
  return out.points.size() < 2 ? FaultStick{} : out;
}

} // namespace detail

StickOrder orderSticks(const std::vector<FaultStick>& sticks) {
  StickOrder result;
  result.reversed.assign(sticks.size(), false);
  std::vector<FaultStick> cleaned;
  std::vector<std::size_t> original;
  for (std::size_t i = 0; i < sticks.size(); ++i) {
    bool reversed = false;
    FaultStick stick = detail::cleanedStick(sticks[i], reversed);
    if (stick.points.empty())
      continue;
    result.reversed[i] = reversed;
    cleaned.push_back(std::move(stick));
    original.push_back(i);
  }
  if (cleaned.size() > detail::kMaxSticks)
    throw InvalidInputError("ordering fault sticks",
                            std::to_string(cleaned.size()) + " sticks are more than the " +
                                std::to_string(detail::kMaxSticks) +
                                " that can be ordered. Thin them or split the fault.");
  std::vector<std::size_t> sorted(cleaned.size());
  std::iota(sorted.begin(), sorted.end(), std::size_t{0});
  std::stable_sort(sorted.begin(), sorted.end(), [&](std::size_t a, std::size_t b) {
    return detail::before(cleaned[a], cleaned[b]);
  });
  std::vector<FaultStick> in_order;
  for (const std::size_t i : sorted)
    in_order.push_back(cleaned[i]);

  // Sticks run the way their neighbour does; which of the two ways is decided for all of them
  // together.
  Vector3 previous = Vector3::Zero();
  double fall = 0.0;
  for (const std::size_t k : detail::shortestPath(in_order)) {
    const std::size_t i = original[sorted[k]];
    Vector3 run = in_order[k].points.back() - in_order[k].points.front();
    if (run.dot(previous) < 0.0) {
      result.reversed[i] = !result.reversed[i];
      run = -run;
    }
    fall -= run.z();
    previous = run;
    result.order.push_back(i);
  }
  if (fall < 0.0)
    for (const std::size_t i : result.order)
      result.reversed[i] = !result.reversed[i];
  return result;
}

} // namespace graben
