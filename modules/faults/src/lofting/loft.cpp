#include "lofting/smooth_loft.h"
#include "lofting/sticks.h"
#include "meshes/cleaning.h"

#include "graben/core/errors.h"
#include "graben/faults/fault_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace graben {
namespace {

constexpr double kMostPoints = 2e7; // of a lofted fault; more can only be a wrong spacing
constexpr std::size_t kMostNodes = 1000; // of a stick
constexpr std::size_t kLargestTable =
    4000000; // entries of the table that finds the best strip between two sticks

double medianStep(const std::vector<FaultStick>& sticks) {
  std::vector<double> steps;
  for (const FaultStick& s : sticks)
    for (std::size_t i = 0; i + 1 < s.points.size(); ++i)
      steps.push_back((s.points[i + 1] - s.points[i]).norm());
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle;
}

/// The stick's own points and as many between them as keep its edges within the spacing.
Points refined(const FaultStick& stick, double spacing) {
  Points out{stick.points.front()};
  for (std::size_t i = 0; i + 1 < stick.points.size(); ++i) {
    const Vector3& a = stick.points[i];
    const Vector3& b = stick.points[i + 1];
    const double parts = std::max(1.0, std::ceil((b - a).norm() / spacing * (1.0 - 1e-9)));
    for (double k = 1.0; k < parts; k += 1.0)
      out.push_back(a + (b - a) * (k / parts));
    out.push_back(b);
  }
  return out;
}

/// Nodes far closer than tells of the stick are left out.
void thin(FaultStick& stick) {
  if (stick.points.size() <= kMostNodes)
    return;
  const double least = detail::length(stick) / static_cast<double>(kMostNodes);
  Points kept{stick.points.front()};
  double walked = 0.0;
  for (std::size_t i = 1; i < stick.points.size(); ++i) {
    walked += (stick.points[i] - stick.points[i - 1]).norm();
    if (walked < least && i + 1 < stick.points.size())
      continue;
    kept.push_back(stick.points[i]);
    walked = 0.0;
  }
  stick.points = std::move(kept);
}

/// One step down the strip between two sticks: on the left one, or on the right one.
using Steps = std::vector<bool>; // true: left

Steps evenSteps(std::size_t left, std::size_t right) {
  Steps steps;
  std::size_t i = 0;
  std::size_t j = 0;
  while (i + 1 < left || j + 1 < right) {
    const bool on_left =
        j + 1 == right || (i + 1 < left && (i + 1) * (right - 1) <= (j + 1) * (left - 1));
    steps.push_back(on_left);
    (on_left ? i : j) += 1;
  }
  return steps;
}

/// The steps with the least total length of diagonals.
Steps shortestSteps(const Points& left, const Points& right) {
  const std::size_t rows = left.size();
  const std::size_t columns = right.size();
  if (columns > kLargestTable / rows)
    return evenSteps(rows, columns);
  std::vector<double> cost(rows * columns, std::numeric_limits<double>::infinity());
  std::vector<bool> from_left(rows * columns, false);
  cost[0] = 0.0;
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t j = 0; j < columns; ++j) {
      const std::size_t at = i * columns + j;
      const double span = (left[i] - right[j]).norm();
      if (j > 0)
        cost[at] = cost[at - 1] + span;
      if (i > 0 && cost[at - columns] + span < cost[at] * (j > 0 ? 1.0 - 1e-12 : 1.0)) {
        cost[at] = cost[at - columns] + span;
        from_left[at] = true;
      }
    }
  Steps steps;
  for (std::size_t i = rows - 1, j = columns - 1; i + j > 0;) {
    const bool on_left = from_left[i * columns + j];
    steps.push_back(on_left);
    (on_left ? i : j) -= 1;
  }
  std::reverse(steps.begin(), steps.end());
  return steps;
}

void addStrip(TriangleMesh& mesh, const Points& left, Index first_left, const Points& right,
              Index first_right) {
  Index i = first_left;
  Index j = first_right;
  for (const bool on_left : shortestSteps(left, right)) {
    if (on_left) {
      mesh.triangles.push_back({i, i + 1, j});
      ++i;
    } else {
      mesh.triangles.push_back({i, j + 1, j});
      ++j;
    }
  }
}

} // namespace

FaultSurface FaultSurface::loft(std::string name, const std::vector<FaultStick>& sticks,
                                double spacing) {
  const std::string stage = "lofting fault " + name;
  if (!std::isfinite(spacing) || spacing < 0.0)
    throw InvalidInputError(stage, "The spacing must be zero or positive.");
  const StickOrder order = orderSticks(sticks);
  if (order.order.size() < 2)
    throw InvalidInputError(stage,
                            "A fault needs two sticks or more with two distinct points each; " +
                                std::to_string(order.order.size()) + " of " +
                                std::to_string(sticks.size()) + " can be used.");
  std::vector<FaultStick> turned;
  double total = 0.0;
  for (const std::size_t i : order.order) {
    bool was_reversed = false;
    turned.push_back(detail::cleanedStick(sticks[i], was_reversed));
    if (was_reversed != order.reversed[i])
      std::reverse(turned.back().points.begin(), turned.back().points.end());
    thin(turned.back());
    total += detail::length(turned.back());
  }
  if (spacing == 0.0)
    spacing = medianStep(turned);
  if (!(total / spacing < kMostPoints))
    throw InvalidInputError(stage, "The spacing is far too small for sticks of this length.");

  TriangleMesh mesh;
  Points left;
  Index first_left = 0;
  for (const FaultStick& stick : turned) {
    Points right = refined(stick, spacing);
    const auto first_right = static_cast<Index>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), right.begin(), right.end());
    if (!left.empty())
      addStrip(mesh, left, first_left, right, first_right);
    left = std::move(right);
    first_left = first_right;
  }
  FaultSurface fault = fromMesh(std::move(name), mesh);
  fault.tip_lines = {turned.front().points, turned.back().points};
  if (detail::familyOf(detail::FramedSticks(turned)) == detail::StickFamily::AlongStrike) {
    fault.tip_lines.assign(2, {});
    for (const FaultStick& stick : turned) {
      fault.tip_lines[0].push_back(stick.points.front());
      fault.tip_lines[1].push_back(stick.points.back());
    }
  }
  return fault;
}

} // namespace graben
