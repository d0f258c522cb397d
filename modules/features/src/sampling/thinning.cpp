#include "sampling/thinning.h"

#include "graben/mesh/bounds.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace graben::detail {

namespace {

struct InCube {
  std::array<std::int64_t, 3> cube;
  Index point;

  bool operator<(const InCube& other) const { return cube != other.cube ? cube < other.cube : point < other.point; }
};

} // namespace

ThinnedCloud thinned(const Points& points, double size) {
  std::vector<InCube> order;
  order.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].allFinite())
      continue;
    InCube entry;
    for (int axis = 0; axis < 3; ++axis)
      entry.cube[static_cast<std::size_t>(axis)] = std::llround(std::floor(points[i][axis] / size));
    entry.point = static_cast<Index>(i);
    order.push_back(entry);
  }
  std::sort(order.begin(), order.end());
  ThinnedCloud result;
  result.of.assign(points.size(), -1);
  for (std::size_t first = 0, last = 0; first < order.size(); first = last) {
    Vector3 sum = Vector3::Zero();
    for (; last < order.size() && order[last].cube == order[first].cube; ++last) {
      sum += points[static_cast<std::size_t>(order[last].point)];
      result.of[static_cast<std::size_t>(order[last].point)] = static_cast<Index>(result.points.size());
    }
    result.points.push_back(sum / static_cast<double>(last - first));
  }
  return result;
}

} // namespace graben::detail
