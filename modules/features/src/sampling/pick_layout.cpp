#include "graben/features/pick_layout.h"

#include "graben/core/median.h"
#include "graben/core/threads.h"
#include "sampling/thinning.h"

#include <algorithm>
#include <cmath>

namespace graben {

namespace {

constexpr std::size_t kSample = 8000;
constexpr std::size_t kRun = 32;          // samples in a row, which lie near each other, are judged together
constexpr double kFewRuns = 0.01;         // of the runs may look like lines by chance
constexpr double kByChance = 2.0;         // runs of few may, too
constexpr double kLeastArea = 0.15;       // of the area that picks on lines stand for, in that of all: less is chance
constexpr double kDenseStep = 1.5;        // median distances to the nearest: side of the square that a dense pick stands for, about
constexpr double kWide = 6.2;             // cells: the distance up to which points are counted
constexpr double kLineGrowth = 3.0;       // of the number of points when the distance doubles: 2 on a line, 4 on a surface
constexpr double kSurfaceGrowth = 3.4;    // what lies about the crossings of lines stays below
constexpr double kStep = M_SQRT2;         // from level to level
constexpr double kCellsBetweenLines = 5.0; // where the growth of the number is first that of a surface
constexpr double kHighest = 0.5;          // of the cloud's extent: farther no points are counted
constexpr std::size_t kFewest = 30;       // points of a thinned cloud
constexpr std::size_t kGrain = 256;

/// Numbers of points around a place.
struct Counts {
  double near = 0.0; ///< within half the distance
  double all = 0.0;

  void add(const Counts& other) {
    near += other.near;
    all += other.all;
  }
  bool likeSurface() const { return near > 0.0 && all >= kSurfaceGrowth * near; }
  bool likeLine() const { return near > 0.0 && all < kLineGrowth * near; }
};

Counts countAround(const NeighborGrid& grid, const Vector3& place, double distance, PointsAround& around) {
  grid.collectWithin(place, distance, around);
  Counts counts;
  for (std::size_t i = 0; i < around.count; ++i) {
    counts.all += around.squared_distance[i] > 0.0 ? 1.0 : 0.0;
    counts.near += around.squared_distance[i] > 0.0 && around.squared_distance[i] <= 0.25 * distance * distance ? 1.0 : 0.0;
  }
  return counts;
}

/// The distance to the nearest other place; 0 if there is none.
double spacingAt(const NeighborGrid& grid, const Vector3& place, std::vector<Neighbor>& near) {
  for (std::size_t count = 4;; count *= 4) {
    grid.nearest(place, count, near);
    if (near.empty())
      return 0.0;
    if (near.back().squared_distance > 0.0 || near.size() < count)
      break;
  }
  const auto other = std::find_if(near.begin(), near.end(), [](const Neighbor& n) { return n.squared_distance > 0.0; });
  return other == near.end() ? 0.0 : std::sqrt(other->squared_distance);
}

/// What a look at some of the picks tells.
struct FirstLook {
  double spacing = 0.0; ///< median; along the lines, if some are
  bool has_lines = false;
};

FirstLook lookAt(const NeighborGrid& grid, unsigned threads) {
  const std::vector<Index>& order = grid.order();
  const std::size_t count = std::min(kSample, order.size());
  const std::size_t runs = (count + kRun - 1) / kRun;
  std::vector<double> spacings(count);
  std::vector<char> lines(runs);
  const auto place = [&](std::size_t i) -> const Vector3& { return grid.points()[static_cast<std::size_t>(order[i * order.size() / count])]; };
  parallelBlocks(count, kRun, threads, [&](std::size_t begin, std::size_t end) {
    std::vector<Neighbor> near;
    PointsAround around;
    for (std::size_t i = begin; i < end; ++i)
      spacings[i] = spacingAt(grid, place(i), near);
    const double spacing = median({spacings.begin() + static_cast<std::ptrdiff_t>(begin), spacings.begin() + static_cast<std::ptrdiff_t>(end)});
    Counts sum;
    for (std::size_t i = begin; i < end && spacing > 0.0; ++i)
      sum.add(countAround(grid, place(i), kWide * spacing, around));
    lines[begin / kRun] = sum.likeLine() ? 1 : 0;
  });
  const auto found = static_cast<double>(std::count(lines.begin(), lines.end(), 1));
  return {median(std::move(spacings)), found > std::max(kByChance, kFewRuns * static_cast<double>(runs))};
}

/// For each point of a thinned cloud whether the numbers of points around it and its neighbours grow as on a surface.
std::vector<char> likeSurface(const Points& points, double distance, unsigned threads) {
  const NeighborGrid grid(points, 0.5 * distance, threads);
  std::vector<Counts> counts(points.size());
  parallelBlocks(points.size(), kGrain, threads, [&](std::size_t begin, std::size_t end) {
    PointsAround around;
    for (std::size_t i = begin; i < end; ++i)
      counts[i] = countAround(grid, points[i], distance, around);
  });
  std::vector<char> found(points.size());
  parallelBlocks(points.size(), kGrain, threads, [&](std::size_t begin, std::size_t end) {
    PointsAround around;
    for (std::size_t i = begin; i < end; ++i) {
      grid.collectWithin(points[i], distance, around);
      Counts sum;
      for (std::size_t k = 0; k < around.count; ++k)
        sum.add(counts[static_cast<std::size_t>(around.index[k])]);
      found[i] = sum.likeSurface() ? 1 : 0;
    }
  });
  return found;
}

/// Thins the cloud level by level and notes for each point at which size of cells it is dense in all directions.
class Levels {
public:
  Levels(const NeighborGrid& grid, double spacing, unsigned threads)
    : grid_(grid), threads_(threads), size_(spacing), cell_(grid.points().size(), -1.0F), of_(grid.points().size()) {
    for (std::size_t i = 0; i < of_.size(); ++i)
      of_[i] = grid.points()[i].allFinite() ? static_cast<Index>(i) : -1;
    extent_ = boundsOf(grid.points(), threads).diagonal();
  }

  /// \return for each point the size of cells, 0 where the picks themselves are dense enough, -1 where none does
  std::vector<float> run() {
    Points points = grid_.points();
    for (float size = 0.0F; kWide * size_ < kHighest * extent_; size = static_cast<float>(size_ *= kStep)) {
      detail::ThinnedCloud cloud = detail::thinned(points, size_);
      if (cloud.points.size() < kFewest || !settle(cloud, size))
        break;
      points = std::move(cloud.points);
    }
    return std::move(cell_);
  }

private:
  /// \return whether points are left that have no size yet
  bool settle(const detail::ThinnedCloud& cloud, float size) {
    const std::vector<char> good = likeSurface(cloud.points, kWide * size_, threads_);
    bool left = false;
    for (std::size_t i = 0; i < of_.size(); ++i) {
      if (of_[i] < 0)
        continue;
      of_[i] = cloud.of[static_cast<std::size_t>(of_[i])];
      if (cell_[i] < 0.0F && good[static_cast<std::size_t>(of_[i])] != 0)
        cell_[i] = size;
      left = left || cell_[i] < 0.0F;
    }
    return left;
  }

  const NeighborGrid& grid_;
  unsigned threads_;
  double size_;
  double extent_ = 0.0;
  std::vector<float> cell_;
  std::vector<Index> of_; ///< for each point its place in the cloud last thinned
};

/// Points without a size take that of the nearest that has one.
void fillIn(const NeighborGrid& grid, std::vector<float>& cells, unsigned threads) {
  Points known = grid.points();
  std::vector<Index> unknown;
  for (std::size_t i = 0; i < cells.size(); ++i)
    if (cells[i] < 0.0F) {
      unknown.push_back(static_cast<Index>(i));
      known[i].setConstant(std::numeric_limits<double>::quiet_NaN());
    }
  if (unknown.empty())
    return;
  const NeighborGrid around(known, 0.0, threads);
  std::vector<float> found(unknown.size(), 0.0F);
  parallelFor(unknown.size(), kGrain, threads, [&](std::size_t i) {
    const Vector3& place = grid.points()[static_cast<std::size_t>(unknown[i])];
    const Neighbor nearest = place.allFinite() ? around.nearestOne(place) : Neighbor();
    if (nearest.index >= 0)
      found[i] = cells[static_cast<std::size_t>(nearest.index)];
  });
  for (std::size_t i = 0; i < unknown.size(); ++i)
    cells[static_cast<std::size_t>(unknown[i])] = found[i];
}

constexpr double kUpper = 0.75;  // quantile of the line distances around that a place takes
constexpr double kAround = 2.0;  // line distances
constexpr double kFine = 0.125;  // line distances: what lies nearer than that has the same

/// Where lines cross, they seem denser than they are: each place takes a high one of the distances around it.
void smooth(const NeighborGrid& grid, std::vector<float>& distances, unsigned threads) {
  std::vector<double> known;
  for (const float distance : distances)
    if (distance > 0.0F)
      known.push_back(static_cast<double>(distance));
  if (known.empty())
    return;
  const double usual = median(std::move(known));
  const detail::ThinnedCloud cloud = detail::thinned(grid.points(), kFine * usual);
  std::vector<float> largest(cloud.points.size(), 0.0F);
  for (std::size_t i = 0; i < distances.size(); ++i)
    if (cloud.of[i] >= 0)
      largest[static_cast<std::size_t>(cloud.of[i])] = std::max(largest[static_cast<std::size_t>(cloud.of[i])], distances[i]);
  const NeighborGrid around(cloud.points, 0.0, threads);
  std::vector<float> smoothed(largest.size());
  parallelBlocks(largest.size(), kGrain, threads, [&](std::size_t begin, std::size_t end) {
    PointsAround found;
    std::vector<float> values;
    for (std::size_t i = begin; i < end; ++i) {
      const double own = static_cast<double>(largest[i]);
      around.collectWithin(cloud.points[i], kAround * (own > 0.0 ? own : usual), found);
      values.clear();
      for (std::size_t k = 0; k < found.count; ++k)
        values.push_back(largest[static_cast<std::size_t>(found.index[k])]);
      const auto upper = values.begin() + static_cast<std::ptrdiff_t>(kUpper * static_cast<double>(values.size() - 1));
      std::nth_element(values.begin(), upper, values.end());
      smoothed[i] = *upper;
    }
  });
  for (std::size_t i = 0; i < distances.size(); ++i)
    if (cloud.of[i] >= 0)
      distances[i] = smoothed[static_cast<std::size_t>(cloud.of[i])];
}

} // namespace

PickLayout pickLayout(const NeighborGrid& grid, unsigned threads) {
  PickLayout layout;
  if (grid.size() < kFewest)
    return layout;
  const FirstLook look = lookAt(grid, threads);
  if (!look.has_lines || !(look.spacing > 0.0))
    return layout;
  layout.line_distances = Levels(grid, look.spacing, threads).run();
  fillIn(grid, layout.line_distances, threads);
  for (float& cell : layout.line_distances)
    cell = static_cast<float>(kCellsBetweenLines * static_cast<double>(cell));
  smooth(grid, layout.line_distances, threads);
  std::vector<double> distances;
  double area = 0.0;
  for (const float distance : layout.line_distances)
    if (distance > 0.0F) {
      distances.push_back(static_cast<double>(distance));
      area += static_cast<double>(distance) * look.spacing;
    }
  const double dense = static_cast<double>(grid.size() - distances.size()) * std::pow(kDenseStep * look.spacing, 2);
  if (!(area > kLeastArea * (area + dense)))
    return {};
  std::sort(distances.begin(), distances.end());
  layout.along_lines = true;
  layout.along = look.spacing;
  layout.share = static_cast<double>(distances.size()) / static_cast<double>(grid.size());
  layout.line_distance = distances[distances.size() / 2];
  layout.farthest_lines = distances[distances.size() * 95 / 100];
  return layout;
}

} // namespace graben
