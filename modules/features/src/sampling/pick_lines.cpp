#include "graben/features/pick_lines.h"

#include "graben/core/threads.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace graben {

namespace {

constexpr double kAround = 0.2;       // line distances: how far a row is looked at
constexpr double kAroundPicks = 1.6;  // or so many distances along it
constexpr double kAhead = 2.5;        // times as far the next picks of a line may be
constexpr double kThin = 0.05;        // smaller to larger eigenvalue of the places in a row, at most
constexpr double kStraight = 0.97;    // cosine of the directions of rows that go on in one another
constexpr double kBeside = 0.15;      // of the way ahead
constexpr double kBesidePicks = 0.3;  // and of the distance along
constexpr double kAtCrossing = 0.5;   // distances along, that a pick about a crossing is beside its line
constexpr std::size_t kFewest = 8;
constexpr std::size_t kGrain = 256;

class LineTracing {
public:
  LineTracing(const Points& points, const PickLayout& layout, unsigned threads)
    : layout_(layout), threads_(threads), map_(points), direction_(points.size(), Vector3::Zero()), parent_(points.size()) {
    for (std::size_t i = 0; i < map_.size(); ++i)
      if (layout_.line_distances[i] > 0.0F)
        map_[i].z() = 0.0;
      else
        map_[i].setConstant(std::numeric_limits<double>::quiet_NaN());
    std::iota(parent_.begin(), parent_.end(), 0);
  }

  std::vector<Index> run() {
    const NeighborGrid grid(map_, 0.0, threads_);
    parallelBlocks(map_.size(), kGrain, threads_, [&](std::size_t begin, std::size_t end) {
      PointsAround around;
      for (std::size_t i = begin; i < end; ++i)
        if (map_[i].allFinite())
          direction_[i] = direction(grid, i, around);
    });
    PointsAround around;
    for (std::size_t i = 0; i < map_.size(); ++i)
      if (inRow(i))
        join(grid, i, around);
    joinCrossings(grid);
    return numbered();
  }

private:
  bool inRow(std::size_t i) const { return !direction_[i].isZero(); }
  double reach(std::size_t i) const { return std::max(kAround * static_cast<double>(layout_.line_distances[i]), kAroundPicks * layout_.along); }

  /// Of the row that a pick lies in; 0 where places around lie in no row.
  Vector3 direction(const NeighborGrid& grid, std::size_t i, PointsAround& around) const {
    grid.collectWithin(map_[i], reach(i), around);
    Eigen::Matrix2d moments = Eigen::Matrix2d::Zero();
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (std::size_t k = 0; k < around.count; ++k) {
      const Eigen::Vector2d off(around.dx[k], around.dy[k]);
      moments += off * off.transpose();
      sum += off;
    }
    moments -= sum * sum.transpose() / static_cast<double>(around.count);
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(moments);
    if (!(axes.eigenvalues()[1] > 0.0) || axes.eigenvalues()[0] > kThin * axes.eigenvalues()[1])
      return Vector3::Zero();
    return {axes.eigenvectors()(0, 1), axes.eigenvectors()(1, 1), 0.0};
  }

  std::size_t root(std::size_t i) {
    while (parent_[i] != i)
      i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  void join(const NeighborGrid& grid, std::size_t i, PointsAround& around) {
    grid.collectWithin(map_[i], kAhead * reach(i), around);
    for (std::size_t k = 0; k < around.count; ++k) {
      const auto other = static_cast<std::size_t>(around.index[k]);
      if (other <= i || !inRow(other) || std::abs(direction_[i].dot(direction_[other])) < kStraight)
        continue;
      const double ahead = std::abs(around.dx[k] * direction_[i].x() + around.dy[k] * direction_[i].y());
      const double beside = std::sqrt(std::max(0.0, around.squared_distance[k] - ahead * ahead));
      if (beside > kBeside * ahead + kBesidePicks * layout_.along)
        continue;
      const std::size_t a = root(i), b = root(other);
      parent_[std::max(a, b)] = std::min(a, b);
    }
  }

  /// Picks that lie in no row go to the row in whose line they lie best.
  void joinCrossings(const NeighborGrid& grid) {
    std::vector<std::size_t> best(map_.size());
    std::iota(best.begin(), best.end(), 0);
    parallelBlocks(map_.size(), kGrain, threads_, [&](std::size_t begin, std::size_t end) {
      PointsAround around;
      for (std::size_t i = begin; i < end; ++i) {
        if (!map_[i].allFinite() || inRow(i))
          continue;
        grid.collectWithin(map_[i], kAhead * reach(i), around);
        std::pair<double, std::size_t> least{kAtCrossing * layout_.along, i};
        for (std::size_t k = 0; k < around.count; ++k) {
          const auto other = static_cast<std::size_t>(around.index[k]);
          if (inRow(other))
            least = std::min(least, {std::abs(around.dx[k] * direction_[other].y() - around.dy[k] * direction_[other].x()), other});
        }
        best[i] = least.second;
      }
    });
    for (std::size_t i = 0; i < map_.size(); ++i)
      if (best[i] != i)
        parent_[i] = root(best[i]);
  }

  std::vector<Index> numbered() {
    std::vector<std::size_t> count(map_.size(), 0);
    for (std::size_t i = 0; i < map_.size(); ++i)
      ++count[root(i)];
    std::vector<Index> number(map_.size(), -1), line(map_.size(), -1);
    Index next = 0;
    for (std::size_t i = 0; i < map_.size(); ++i) {
      const std::size_t of = root(i);
      if (count[of] < kFewest)
        continue;
      if (number[of] < 0)
        number[of] = next++;
      line[i] = number[of];
    }
    return line;
  }

  const PickLayout& layout_;
  unsigned threads_;
  Points map_;
  Points direction_;
  std::vector<std::size_t> parent_; ///< of each pick one of its line
};

} // namespace

std::vector<Index> pickLines(const Points& points, const PickLayout& layout, unsigned threads) {
  if (!layout.along_lines)
    return std::vector<Index>(points.size(), -1);
  return LineTracing(points, layout, threads).run();
}

} // namespace graben
