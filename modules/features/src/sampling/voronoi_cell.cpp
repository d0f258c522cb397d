#include "sampling/voronoi_cell.h"

#include <algorithm>

namespace graben::detail {
namespace {

using Corners = std::vector<Eigen::Vector2d>;

/// Keeps what is closer to (0, 0) than to q.
void clip(Corners& cell, Corners& scratch, const Eigen::Vector2d& q) {
  const double limit = 0.5 * q.squaredNorm();
  scratch.clear();
  for (std::size_t i = 0; i < cell.size(); ++i) {
    const Eigen::Vector2d &a = cell[i], &b = cell[(i + 1) % cell.size()];
    const double over_a = a.dot(q) - limit, over_b = b.dot(q) - limit;
    if (over_a <= 0.0)
      scratch.push_back(a);
    if ((over_a < 0.0 && over_b > 0.0) || (over_a > 0.0 && over_b < 0.0))
      scratch.push_back(a + (b - a) * (over_a / (over_a - over_b)));
  }
  cell.swap(scratch);
}

/// Whether no pick is closer to both ends than they are to each other: an edge of the relative
/// neighbourhood graph, which holds the minimum spanning tree and, unlike other such graphs, has no
/// diagonals in a grid that is not quite square.
bool isStep(const Eigen::Vector2d& q, const std::vector<Eigen::Vector2d>& neighbors) {
  const double squared = q.squaredNorm();
  return std::none_of(neighbors.begin(), neighbors.end(),
                      [&q, squared](const Eigen::Vector2d& other) {
                        return other.squaredNorm() < squared && (other - q).squaredNorm() < squared;
                      });
}

} // namespace

VoronoiCell voronoiCell(const std::vector<Eigen::Vector2d>& neighbors, double known) {
  VoronoiCell result;
  const double far = 4.0 * known;
  Corners cell = {{-far, -far}, {far, -far}, {far, far}, {-far, far}}, scratch;
  for (const Eigen::Vector2d& q : neighbors) {
    clip(cell, scratch, q);
    if (q.norm() > result.longest_step && isStep(q, neighbors))
      result.longest_step = q.norm();
  }
  result.complete = true;
  for (const Eigen::Vector2d& corner : cell) {
    if (2.0 * corner.norm() <= known)
      result.corner_distances.push_back(corner.norm());
    else
      result.complete = false;
  }
  return result;
}

} // namespace graben::detail
