#include "faults/stick_turns.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace graben {
namespace {

constexpr double steep = 0.3; // as no trace on a map is, though it goes up and down with the horizon

} // namespace

bool isSteep(const Points& line, double share) {
  const Vector3 along = line.back() - line.front();
  return std::abs(along.z()) > share * along.head<2>().norm();
}

std::vector<Points> sticksOfTurns(const Points& list) {
  std::size_t up = 0;
  for (std::size_t i = 1; i < list.size(); ++i)
    up += list[i].z() > list[i - 1].z() ? 1 : 0;
  const double way = 2 * up >= list.size() ? 1.0 : -1.0;
  std::vector<Points> sticks;
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (i == 0 || way * (list[i].z() - list[i - 1].z()) <= 0.0)
      sticks.emplace_back();
    sticks.back().push_back(list[i]);
  }
  const bool good =
      sticks.size() > 1 && std::all_of(sticks.begin(), sticks.end(),
                                       [](const Points& s) { return s.size() > 1 && isSteep(s, steep); });
  return good ? sticks : std::vector<Points>{};
}

bool runsToAndFro(const Points& list) {
  constexpr double times = 3.0;
  Eigen::AlignedBox3d box;
  double length = 0.0;
  for (std::size_t i = 0; i < list.size(); ++i) {
    box.extend(list[i]);
    length += i == 0 ? 0.0 : (list[i] - list[i - 1]).norm();
  }
  return list.size() > 2 && length > times * box.sizes().norm();
}

} // namespace graben
