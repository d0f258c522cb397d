#include "robust_plane.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace graben::detail {
namespace {

constexpr double LINE = 1e-6; ///< sine of the angle under which three points lie on a line
constexpr int TRIPLES = 32, ABSOLUTE_PASSES = 6, BIWEIGHT_PASSES = 4;
constexpr double CLEAN = 2.5;          ///< deviations that no point is off where there are no outliers
constexpr double NARROW = 1e-3;        ///< square of the width over the length of points that are all but on a line
constexpr double BIWEIGHT_WIDTH = 4.685, DEVIATION_FROM_MEDIAN = 1.4826;

/// Numbers that look random and are the same everywhere (splitmix64, public domain, S. Vigna).
class Sequence {
public:
  std::size_t below(std::size_t count) {
    std::uint64_t x = state_ += 0x9e3779b97f4a7c15ULL;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
    return static_cast<std::size_t>((x ^ (x >> 31)) % count);
  }

private:
  std::uint64_t state_ = 0;
};

class PlaneFit {
public:
  PlaneFit(const std::vector<WeightedPoint>& points, double scale)
      : points_(points)
      , least_scale_(scale) {}

  bool fit() {
    if (points_.size() < 3 || !chooseDirection())
      return false;
    double sum = 0.0;
    for (const WeightedPoint& p : points_) {
      centre_ += p.weight * (p.position - points_.front().position);
      sum += p.weight;
    }
    centre_ = centre_ / sum + points_.front().position;
    model_ = Vector3(frame_.col(2).dot(start_ - centre_), 0.0, 0.0);
    robust_.resize(points_.size());
    residuals_.resize(points_.size());
    for (const WeightedPoint& p : points_)
      local_.emplace_back(frame_.transpose() * (p.position - centre_));
    measure();
    weighByAbsolute();
    for (int pass = 0; pass <= ABSOLUTE_PASSES + BIWEIGHT_PASSES; ++pass) {
      if (!solve())
        return false;
      if (pass < ABSOLUTE_PASSES)
        weighByAbsolute();
      else if (pass < ABSOLUTE_PASSES + BIWEIGHT_PASSES)
        weighByBiweight();
    }
    return true;
  }

  PlaneAt at(const Vector3& query) const {
    const Vector3 local = frame_.transpose() * (query - centre_);
    const Vector3 row(1.0, local.x(), local.y());
    PlaneAt plane;
    const double steepness = std::sqrt(1.0 + model_.tail<2>().squaredNorm());
    plane.normal = frame_ * Vector3(-model_[1], -model_[2], 1.0) / steepness;
    plane.offset = (local.z() - row.dot(model_)) / steepness;
    plane.leverage = row.dot(factor_.solve(row));
    plane.reach = local.norm();
    plane.valid =
        plane.normal.allFinite() && std::isfinite(plane.offset) && std::isfinite(plane.leverage);
    return plane;
  }

private:
  /// Heights are measured across the plane, of those through some triples of points, that half of
  /// all are nearest to; principal axes would be the outliers'.
  bool chooseDirection() {
    Sequence sequence;
    double least = std::numeric_limits<double>::infinity();
    for (int t = 0; t < TRIPLES; ++t) {
      const Vector3& a = points_[sequence.below(points_.size())].position;
      const Vector3 ab = points_[sequence.below(points_.size())].position - a;
      const Vector3 ac = points_[sequence.below(points_.size())].position - a;
      const Vector3 normal = ab.cross(ac);
      if (!(normal.norm() > LINE * ab.norm() * ac.norm()))
        continue;
      const Vector3 unit = normal.normalized();
      if (!halfAreNearer(a, unit, least))
        continue;
      least = medianOf(distances_);
      setFrame(unit);
      start_ = a;
    }
    return std::isfinite(least);
  }

  /// True if the median distance to a plane is less than \a limit; leaves the distances behind.
  bool halfAreNearer(const Vector3& a, const Vector3& normal, double limit) {
    distances_.resize(points_.size());
    std::size_t nearer = 0;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      distances_[i] = std::abs(normal.dot(points_[i].position - a));
      nearer += distances_[i] < limit ? 1 : 0;
    }
    return nearer > points_.size() / 2;
  }

  static double medianOf(std::vector<double>& values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
  }

  void setFrame(const Vector3& normal) {
    frame_.col(2) = normal;
    frame_.col(0) = normal.unitOrthogonal();
    frame_.col(1) = normal.cross(frame_.col(0));
  }

  bool solve() {
    Eigen::Matrix3d normal_matrix = Eigen::Matrix3d::Zero(); // the factorisation reads the lower half
    Vector3 right = Vector3::Zero();
    for (std::size_t i = 0; i < local_.size(); ++i) {
      const Vector3& p = local_[i];
      const double weight = points_[i].weight * robust_[i];
      const double wx = weight * p.x();
      const double wy = weight * p.y();
      const double wz = weight * p.z();
      normal_matrix(0, 0) += weight;
      normal_matrix(1, 0) += wx;
      normal_matrix(1, 1) += wx * p.x();
      normal_matrix(2, 0) += wy;
      normal_matrix(2, 1) += wy * p.x();
      normal_matrix(2, 2) += wy * p.y();
      right += Vector3(wz, wz * p.x(), wz * p.y());
    }
    factor_.compute(normal_matrix);
    if (factor_.info() != Eigen::Success || !factor_.isPositive())
      return false;
    model_ = factor_.solve(right);
    measure();
    return model_.allFinite();
  }

  void measure() {
    for (std::size_t i = 0; i < local_.size(); ++i)
      residuals_[i] = std::abs(local_[i].z() - (model_[0] + local_[i].x() * model_[1] + local_[i].y() * model_[2]));
  }

  void weighByAbsolute() {
    for (std::size_t i = 0; i < points_.size(); ++i)
      robust_[i] = 1.0 / std::max(residuals_[i] / least_scale_, 0.1);
  }

  void weighByBiweight() {
    distances_ = residuals_;
    const double width = BIWEIGHT_WIDTH * std::max(least_scale_, DEVIATION_FROM_MEDIAN * medianOf(distances_));
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const double share = residuals_[i] / width;
      robust_[i] = share < 1.0 ? (1.0 - share * share) * (1.0 - share * share) : 0.0;
    }
  }

  const std::vector<WeightedPoint>& points_;
  double least_scale_;
  Vector3 centre_ = Vector3::Zero();
  Vector3 start_ = Vector3::Zero(); ///< a point of the plane the fit starts from
  Eigen::Matrix3d frame_ = Eigen::Matrix3d::Identity();
  Eigen::LDLT<Eigen::Matrix3d> factor_;
  Vector3 model_ = Vector3::Zero(); ///< height, two slopes
  Points local_; ///< the points in the frame about the centre
  std::vector<double> robust_, residuals_, distances_;
};

/// The least-squares plane, if no point is far from it; else not valid.
PlaneAt planeOfCleanPoints(const Vector3& query, const std::vector<WeightedPoint>& points, double scale) {
  PlaneAt plane;
  if (points.size() < 3)
    return plane;
  const Vector3& first = points.front().position;
  Vector3 centre = Vector3::Zero();
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  double sum = 0.0;
  for (const WeightedPoint& p : points) {
    const Vector3 d = p.position - first;
    const Vector3 weighted = p.weight * d;
    sum += p.weight;
    centre += weighted;
    scatter.noalias() += weighted * d.transpose();
  }
  centre /= sum;
  scatter.noalias() -= sum * centre * centre.transpose();
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes;
  axes.computeDirect(scatter);
  const Vector3& spread = axes.eigenvalues();
  plane.normal = axes.eigenvectors().col(0);
  for (const WeightedPoint& p : points)
    if (!(std::abs(plane.normal.dot(p.position - first - centre)) <= CLEAN * scale))
      return plane;
  const Vector3 d = query - first - centre;
  const double along = axes.eigenvectors().col(2).dot(d), across = axes.eigenvectors().col(1).dot(d);
  plane.offset = plane.normal.dot(d);
  plane.leverage = 1.0 / sum + along * along / spread[2] + across * across / spread[1];
  plane.reach = d.norm();
  plane.valid = spread[1] > NARROW * spread[2] && std::isfinite(plane.offset) && std::isfinite(plane.leverage);
  return plane;
}

} // namespace

PlaneAt robustPlaneAt(const Vector3& query, const std::vector<WeightedPoint>& points,
                      double scale) {
  const PlaneAt clean = planeOfCleanPoints(query, points, scale);
  if (clean.valid)
    return clean;
  PlaneFit fit(points, scale);
  return fit.fit() ? fit.at(query) : PlaneAt();
}

} // namespace graben::detail
