#include "graben/features/sampling.h"

#include "graben/core/errors.h"
#include "graben/core/threads.h"
#include "sampling/local_noise.h"
#include "sampling/voronoi_cell.h"

#include <algorithm>
#include <cmath>

namespace graben {
namespace {

constexpr std::size_t PICKS = 8000;
constexpr std::size_t GRAIN = 64;
constexpr std::size_t FIT_NEIGHBORS = 25;
constexpr std::size_t MAX_NEIGHBORS = 400;

/// What is measured about the sampled picks of one block.
struct Measures {
  std::size_t fit_neighbors = 0;
  std::vector<double> nearest, empty_radii, steps, reaches, plane_variances, quadric_variances;
  void append(const Measures& other) {
    const auto join = [](std::vector<double>& to, const std::vector<double>& from) {
      to.insert(to.end(), from.begin(), from.end());
    };
    join(nearest, other.nearest);
    join(empty_radii, other.empty_radii);
    join(steps, other.steps);
    join(reaches, other.reaches);
    join(plane_variances, other.plane_variances);
    join(quadric_variances, other.quadric_variances);
  }
};

/// The value below which the given share of the values lies; 0 of nothing. Reorders the values.
double quantile(std::vector<double>& values, double share) {
  values.erase(
      std::remove_if(values.begin(), values.end(), [](double v) { return !std::isfinite(v); }),
      values.end());
  if (values.empty())
    return 0.0;
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

class Sampler {
public:
  Sampler(const NeighborGrid& grid, std::size_t fit_neighbors)
      : grid_(grid)
      , points_(grid.points())
      , fit_neighbors_(fit_neighbors) {}

  void measure(Index pick, Measures& measures) {
    const Vector3& p = points_[static_cast<std::size_t>(pick)];
    query(p, fit_neighbors_);
    if (found_.size() < 2)
      return;
    measures.nearest.push_back(std::sqrt(found_[1].squared_distance));
    const auto plane = fit();
    if (!plane)
      return;
    const Eigen::Matrix3d frame = detail::frameAbout(plane->normal);
    const detail::LocalNoise noise = detail::localNoise(points_, indices_, p, frame);
    measures.plane_variances.push_back(noise.about_plane);
    measures.quadric_variances.push_back(noise.about_quadric);
    measureDensity(p, frame, measures);
  }

  /// Share of the neighbourhood's spread that is across the surface; not a number where there is no
  /// plane.
  double thickness(Index pick) {
    query(points_[static_cast<std::size_t>(pick)], fit_neighbors_);
    const auto plane = fit();
    return plane ? plane->curvature : std::numeric_limits<double>::quiet_NaN();
  }

private:
  /// The nearest distinct points, the pick first; more are asked for where points repeat.
  void query(const Vector3& p, std::size_t count) {
    for (std::size_t k = count;; k *= 4) {
      grid_.nearest(p, k, found_);
      known_ = found_.size() == grid_.size() ? std::numeric_limits<double>::infinity()
                                             : std::sqrt(found_.back().squared_distance);
      const auto same = [this](const Neighbor& a, const Neighbor& b) {
        return a.squared_distance == b.squared_distance &&
               points_[static_cast<std::size_t>(a.index)] ==
                   points_[static_cast<std::size_t>(b.index)];
      };
      found_.erase(std::unique(found_.begin(), found_.end(), same), found_.end());
      if (found_.size() >= std::min<std::size_t>(count, 8) || std::isinf(known_) || k > 64 * count)
        return;
    }
  }

  std::optional<detail::FittedPlane> fit() {
    indices_.clear();
    for (const Neighbor& neighbor : found_)
      indices_.push_back(neighbor.index);
    return detail::fitPlane(points_, indices_);
  }

  void measureDensity(const Vector3& p, const Eigen::Matrix3d& frame, Measures& measures) {
    detail::VoronoiCell cell;
    for (std::size_t k = fit_neighbors_;; k *= 2) {
      if (k > fit_neighbors_)
        query(p, k);
      flat_.clear();
      for (const Neighbor& neighbor : found_) {
        const Vector3 local =
            frame.transpose() * (points_[static_cast<std::size_t>(neighbor.index)] - p);
        if (local.head<2>().squaredNorm() > 0.0)
          flat_.emplace_back(local.head<2>());
      }
      const double farthest = std::sqrt(found_.back().squared_distance);
      cell = detail::voronoiCell(flat_, std::isinf(known_) ? 2.0 * farthest : farthest);
      if (cell.complete || k >= MAX_NEIGHBORS || std::isinf(known_))
        break;
    }
    measures.empty_radii.insert(measures.empty_radii.end(), cell.corner_distances.begin(),
                                cell.corner_distances.end());
    measures.steps.push_back(cell.longest_step);
    measures.reaches.push_back(reachAround());
  }

  /// How far the nearest picks that lie in all directions reach: no gap between their directions is wider than a right angle and a little. No less than
  /// known_ where there are none.
  double reachAround() {
    constexpr double kWidestGap = 100.0 * M_PI / 180.0;
    angles_.clear();
    for (const Eigen::Vector2d& q : flat_) {
      const double angle = std::atan2(q.y(), q.x());
      angles_.insert(std::upper_bound(angles_.begin(), angles_.end(), angle), angle);
      double widest = angles_.front() + 2.0 * M_PI - angles_.back();
      for (std::size_t i = 1; i < angles_.size(); ++i)
        widest = std::max(widest, angles_[i] - angles_[i - 1]);
      if (widest <= kWidestGap)
        return q.norm();
    }
    return known_;
  }

  const NeighborGrid& grid_;
  const Points& points_;
  std::size_t fit_neighbors_;
  double known_ = 0.0; ///< all points closer than this are in found_
  std::vector<Neighbor> found_;
  std::vector<Index> indices_;
  std::vector<Eigen::Vector2d> flat_; ///< nearest first
  std::vector<double> angles_;
};

Index sampledPick(const NeighborGrid& grid, std::size_t i, std::size_t count) {
  return grid.order()[i * grid.size() / count];
}

/// Neighbours enough for planes to be wider than the noise is high: the fewest that make
/// neighbourhoods thin, or else those that make them thinnest if that helps a lot. Where it is
/// curvature that makes them thick, the fewest.
std::size_t chooseFitNeighbors(const NeighborGrid& grid) {
  constexpr double THIN = 0.02, HELPS = 0.5;
  const std::size_t count = std::min<std::size_t>(200, grid.size());
  std::size_t best = FIT_NEIGHBORS;
  double first = 0.0, least = std::numeric_limits<double>::infinity();
  for (std::size_t k = FIT_NEIGHBORS; k <= MAX_NEIGHBORS; k *= 2) {
    Sampler sampler(grid, k);
    std::vector<double> thickness;
    for (std::size_t i = 0; i < count; ++i)
      thickness.push_back(sampler.thickness(sampledPick(grid, i, count)));
    const double middle = quantile(thickness, 0.5);
    if (middle < THIN)
      return k;
    if (k == FIT_NEIGHBORS)
      first = middle;
    if (middle < least) {
      least = middle;
      best = k;
    }
  }
  return least < HELPS * first ? best : FIT_NEIGHBORS;
}

Measures measureAll(const NeighborGrid& grid, unsigned threads) {
  const std::size_t fit_neighbors = chooseFitNeighbors(grid);
  const std::size_t count = std::min(PICKS * FIT_NEIGHBORS / fit_neighbors, grid.size());
  std::vector<Measures> parts((count + GRAIN - 1) / GRAIN);
  parallelBlocks(count, GRAIN, threads, [&](std::size_t begin, std::size_t end) {
    Sampler sampler(grid, fit_neighbors);
    for (std::size_t i = begin; i < end; ++i)
      sampler.measure(sampledPick(grid, i, count), parts[begin / GRAIN]);
  });
  Measures all;
  all.fit_neighbors = fit_neighbors;
  for (const Measures& part : parts)
    all.append(part);
  return all;
}

/// Radius that no empty circle between the picks exceeds.
///
/// In a random cloud the squared radii fall off exponentially, in a regular one they are all the
/// same. The fall between the median and the 80 % quantile, which the few corners at borders, holes
/// and faults hardly touch, is continued to the largest of all circles.
double largestEmptyRadius(std::vector<double>& radii, std::size_t picks) {
  constexpr double HIGH = 0.8, MOST = 4.0; // never beyond MOST medians: there it is a gap
  const double middle = quantile(radii, 0.5), high = quantile(radii, HIGH);
  const double fall = (high * high - middle * middle) / std::log(0.5 / (1.0 - HIGH));
  const double circles = 4.0 * static_cast<double>(picks);
  return std::min(MOST * middle, std::sqrt(middle * middle + fall * std::log(0.5 * circles)));
}

/// Standard deviation from the median of variances with \a freedom degrees each, so that those at
/// faults do not count.
double robustDeviation(std::vector<double>& variances, double freedom) {
  const double median_over_mean =
      std::pow(1.0 - 2.0 / (9.0 * freedom), 3.0); // Wilson and Hilferty's chi-squared
  return std::sqrt(quantile(variances, 0.5) / median_over_mean);
}

/// Whether the picks do not all lie on a line: it takes a few of them to see that they do not, all to see that they do.
bool spreadInTwoDirections(const NeighborGrid& grid) {
  constexpr std::size_t FEW = 1000;
  std::vector<Index> few;
  for (std::size_t i = 0; i < std::min(FEW, grid.size()); ++i)
    few.push_back(sampledPick(grid, i, std::min(FEW, grid.size())));
  return detail::fitPlane(grid.points(), few) || detail::fitPlane(grid.points(), grid.order());
}

void requireSurface(const NeighborGrid& grid) {
  if (!spreadInTwoDirections(grid))
    throw InvalidInputError("estimating the sampling of the picks",
                            "The picks are fewer than three distinct points or lie on one line; a "
                            "surface needs three that do not.");
}

} // namespace

Sampling estimateSampling(const NeighborGrid& grid, unsigned threads) {
  requireSurface(grid);
  Measures measures = measureAll(grid, threads);
  constexpr double STEP_MARGIN = 1.2, LARGEST_NOISE = 3.0, REACH_SHARE = 0.6;
  Sampling sampling;
  sampling.spacing = quantile(measures.nearest, 0.5);
  sampling.rho =
      std::max({STEP_MARGIN * quantile(measures.steps, 0.5), STEP_MARGIN * sampling.spacing,
                REACH_SHARE * quantile(measures.reaches, 0.5),
                largestEmptyRadius(measures.empty_radii, grid.size())});
  const auto used = static_cast<double>(measures.fit_neighbors);
  sampling.delta = LARGEST_NOISE * robustDeviation(measures.plane_variances, used - 3.0);
  sampling.sigma = robustDeviation(measures.quadric_variances, used - 6.0);
  return sampling;
}

} // namespace graben
