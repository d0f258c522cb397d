#include "graben/features/tangent_planes.h"

#include "graben/core/errors.h"
#include "graben/core/threads.h"
#include "planes/measured_normals.h"
#include "planes/neighborhood_batch.h"
#include "planes/neighborhood_grower.h"
#include "planes/plane_fit.h"

#include <algorithm>
#include <cmath>

namespace graben {
namespace {

constexpr std::size_t GRAIN = 1024;

void clearPlanes(std::size_t begin, std::size_t end, TangentPlanes& planes) {
  constexpr double NONE = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = begin; i < end; ++i) {
    planes.centres[i].setConstant(NONE);
    planes.normals[i].setConstant(NONE);
    planes.reach[i] = static_cast<float>(NONE);
  }
  if (!planes.curvature.empty())
    std::fill(planes.curvature.begin() + static_cast<std::ptrdiff_t>(begin), planes.curvature.begin() + static_cast<std::ptrdiff_t>(end),
              static_cast<float>(NONE));
}

void clearPlanes(TangentPlanes& planes, unsigned threads) {
  parallelBlocks(planes.normals.size(), 1 << 14, threads, [&](std::size_t begin, std::size_t end) { clearPlanes(begin, end, planes); });
}

TangentPlanes unsetPlanes(std::size_t count, bool with_curvature) {
  TangentPlanes planes;
  planes.centres.resize(count);
  planes.normals.resize(count);
  planes.reach.resize(count);
  planes.curvature.resize(with_curvature ? count : 0);
  return planes;
}

void setPlane(const detail::FittedPlane& plane, double squared_reach, std::size_t i, TangentPlanes& planes) {
  planes.centres[i] = plane.centre;
  planes.normals[i] = plane.normal;
  if (!planes.curvature.empty())
    planes.curvature[i] = static_cast<float>(plane.curvature);
  planes.reach[i] = static_cast<float>(std::sqrt(squared_reach));
}

/// Fits planes to neighbourhoods and mixes in what was measured.
class PlaneFitter {
public:
  PlaneFitter(const Points& points, const detail::MeasuredNormals& measured, double weight)
      : points_(points)
      , measured_(measured)
      , weight_(weight) {}

  /// Sets plane number \a i, of the given place. \param[in] neighbors the pick at that very place first, if there is one
  void fit(const std::vector<Index>& neighbors, const Vector3& place, std::size_t i, TangentPlanes& planes) const {
    if (neighbors.empty())
      return;
    const detail::Scatter scatter = detail::scatterOf(points_, neighbors);
    const bool own = pointOf(neighbors.front()) == place;
    double farthest = own ? scatter.farthest : 0.0;
    for (std::size_t n = 0; !own && n < neighbors.size(); ++n)
      farthest = std::max(farthest, (pointOf(neighbors[n]) - place).squaredNorm());
    const bool pulled =
        !measured_.empty() && std::any_of(neighbors.begin(), neighbors.end(), [&](Index n) { return measured_.has(n); });
    std::optional<detail::FittedPlane> plane;
    if (pulled && own && measured_.has(neighbors.front()))
      plane = measuredPlane(scatter, place, measured_.of(neighbors.front()));
    else if (pulled && neighbors.size() >= 3)
      plane = pulledPlane(scatter, neighbors, place, farthest);
    else if (neighbors.size() >= 3)
      plane = detail::fitPlane(scatter);
    if (plane)
      setPlane(*plane, farthest, i, planes);
  }

private:
  const Vector3& pointOf(Index i) const { return points_[static_cast<std::size_t>(i)]; }

  static detail::FittedPlane measuredPlane(const detail::Scatter& scatter, const Vector3& place, const Vector3& normal) {
    const Eigen::Matrix3d spread = scatter.matrix();
    const double all = spread.trace();
    const double across = normal.dot(spread.selfadjointView<Eigen::Lower>() * normal);
    return {place, normal, all > 0.0 ? std::min(across / all, 1.0 / 3.0) : 0.0};
  }

  std::optional<detail::FittedPlane> pulledPlane(const detail::Scatter& scatter, const std::vector<Index>& neighbors, const Vector3& place,
                                                 double farthest) const {
    const double all = scatter.matrix().trace();
    Eigen::Matrix3d pull = Eigen::Matrix3d::Zero();
    for (const Index n : neighbors) {
      if (!measured_.has(n))
        continue;
      const Vector3& m = measured_.of(n);
      const double weight = weight_ * 0.5 * all * (1.0 - (pointOf(n) - place).squaredNorm() / farthest);
      pull += weight * (Eigen::Matrix3d::Identity() - m * m.transpose()); // as -m m^T, but never negative
    }
    return detail::fitPlane(scatter, pull);
  }

  const Points& points_;
  const detail::MeasuredNormals& measured_;
  double weight_;
};

/// Fits planes to all the neighbourhoods of a batch that are simple.
class BatchFitter {
public:
  void fit(const detail::NeighborhoodBatch& batch, const Points& points, const Index* picks, std::size_t count, std::size_t neighbors, TangentPlanes& planes) {
    scatters_.clear();
    numbers_.clear();
    for (std::size_t n = 0; n < count; ++n) {
      if (!batch.isSimple(n))
        continue;
      numbers_.push_back(static_cast<std::size_t>(picks[n]));
      scatters_.push_back(detail::scatterOf(points[numbers_.back()], batch.moments(n), neighbors));
    }
    planes_.resize(scatters_.size());
    detail::fitPlanes(scatters_.data(), scatters_.size(), planes_.data());
    for (std::size_t n = 0; n < planes_.size(); ++n)
      if (planes_[n])
        setPlane(*planes_[n], scatters_[n].farthest, numbers_[n], planes);
  }

private:
  std::vector<detail::Scatter> scatters_;
  std::vector<std::size_t> numbers_;
  std::vector<std::optional<detail::FittedPlane>> planes_;
};

void check(const NeighborGrid& grid, const TangentPlaneOptions& options) {
  if (options.neighbors < 3)
    throw InvalidInputError(
        "estimating tangent planes",
        "A plane needs 3 neighbours or more; set a larger number of neighbours.");
  if (std::isnan(options.rho_plus_delta) || options.rho_plus_delta < 0.0)
    throw InvalidInputError("estimating tangent planes",
                            "rho + delta must be 0 (no limit) or positive.");
  if (std::isnan(options.max_distance) || options.max_distance < 0.0)
    throw InvalidInputError("estimating tangent planes",
                            "The farthest neighbour's distance must be 0 (no limit) or positive.");
  if (!std::isfinite(options.measured_weight) || options.measured_weight < 0.0)
    throw InvalidInputError("estimating tangent planes", "The weight of measured normals must be 0 or positive.");
  if (grid.points().size() > static_cast<std::size_t>(std::numeric_limits<Index>::max()))
    throw InvalidInputError("estimating tangent planes",
                            "The cloud has more points than a 32-bit index counts.");
}

} // namespace

void growNeighborhood(const NeighborGrid& grid, const FaultNetwork& faults, Index pick,
                      const TangentPlaneOptions& options, std::vector<Index>& neighbors) {
  check(grid, options);
  if (pick < 0 || static_cast<std::size_t>(pick) >= grid.points().size())
    throw InvalidInputError("finding neighbours",
                            "There is no pick number " + std::to_string(pick) + ".");
  detail::NeighborhoodGrower(grid, faults, options).grow(pick, neighbors);
}

TangentPlanes estimateTangentPlanes(const NeighborGrid& grid, const FaultNetwork& faults,
                                    const TangentPlaneOptions& options) {
  check(grid, options);
  const detail::MeasuredNormals measured(grid, options.measured);
  const PlaneFitter fitter(grid.points(), measured, options.measured_weight);
  TangentPlanes planes = unsetPlanes(grid.points().size(), options.with_curvature);
  planes.measured = measured.picks();
  const std::vector<Index>& order = grid.order();
  const bool by_block = grid.inOrder() && !order.empty();
  const auto placeOf = [&](std::size_t i) { return i == 0 ? 0 : i == order.size() ? grid.points().size() : static_cast<std::size_t>(order[i]); };
  if (!by_block)
    clearPlanes(planes, options.threads);
  parallelBlocks(order.size(), GRAIN, options.threads, [&](std::size_t begin, std::size_t end) {
    detail::NeighborhoodGrower grower(grid, faults, options);
    detail::NeighborhoodBatch batch(grid, faults, measured, options);
    BatchFitter batch_fitter;
    std::vector<Index> neighbors;
    if (by_block)
      clearPlanes(placeOf(begin), placeOf(end), planes);
    for (std::size_t first = begin, count = 0; first < end; first += count) {
      const Index* picks = order.data() + first;
      count = batch.extent(picks, end - first);
      batch.find(picks, count);
      batch_fitter.fit(batch, grid.points(), picks, count, options.neighbors, planes);
      for (std::size_t i = 0; i < count; ++i) {
        if (batch.isSimple(i))
          continue;
        grower.grow(picks[i], neighbors);
        fitter.fit(neighbors, grid.points()[static_cast<std::size_t>(picks[i])], static_cast<std::size_t>(picks[i]), planes);
      }
    }
  });
  return planes;
}

TangentPlanes estimateTangentPlanesAt(const NeighborGrid& grid, const FaultNetwork& faults,
                                      const TangentPlaneOptions& options, const Points& places) {
  check(grid, options);
  const detail::MeasuredNormals measured(grid, options.measured);
  const PlaneFitter fitter(grid.points(), measured, options.measured_weight);
  TangentPlanes planes = unsetPlanes(places.size(), options.with_curvature);
  clearPlanes(planes, options.threads);
  for (std::size_t i = 0; i < places.size() && !measured.empty(); ++i) {
    const Neighbor nearest = grid.nearestOne(places[i], 0.0);
    if (nearest.index >= 0 && measured.has(nearest.index))
      planes.measured.push_back(static_cast<Index>(i));
  }
  parallelBlocks(places.size(), GRAIN, options.threads, [&](std::size_t begin, std::size_t end) {
    detail::NeighborhoodGrower grower(grid, faults, options);
    std::vector<Index> neighbors;
    for (std::size_t i = begin; i < end; ++i) {
      grower.growAt(places[i], neighbors);
      fitter.fit(neighbors, places[i], i, planes);
    }
  });
  return planes;
}

} // namespace graben
