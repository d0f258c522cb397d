#include "robust_plane.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace graben::detail {
namespace {

constexpr double LINE = 1e-6; ///< ratio of two eigenvalues below which points lie on a line
constexpr int ABSOLUTE_PASSES = 6, BIWEIGHT_PASSES = 4;
constexpr double BIWEIGHT_WIDTH = 4.685, DEVIATION_FROM_MEDIAN = 1.4826;

class PlaneFit {
public:
  PlaneFit(const std::vector<WeightedPoint>& points, double scale)
      : points_(points)
      , least_scale_(scale) {}

  bool fit() {
    if (points_.size() < 3 || !chooseFrame())
      return false;
    robust_.assign(points_.size(), 1.0);
    for (int pass = 0; pass <= ABSOLUTE_PASSES + BIWEIGHT_PASSES; ++pass) {
      if (!solve())
        return false;
      if (pass < ABSOLUTE_PASSES)
        weighByAbsolute();
      else
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
    plane.valid = plane.normal.allFinite() && std::isfinite(plane.offset) &&
                  std::isfinite(plane.leverage);
    return plane;
  }

private:
  bool chooseFrame() {
    double sum = 0.0;
    centre_.setZero();
    for (const WeightedPoint& p : points_) {
      centre_ += p.weight * (p.position - points_.front().position);
      sum += p.weight;
    }
    centre_ = centre_ / sum + points_.front().position;
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    for (const WeightedPoint& p : points_)
      covariance += p.weight * (p.position - centre_) * (p.position - centre_).transpose();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
    const Vector3 values = solver.eigenvalues();
    if (!(values[2] > 0.0) || !(values[1] > LINE * values[2]))
      return false;
    frame_.col(0) = solver.eigenvectors().col(2);
    frame_.col(1) = solver.eigenvectors().col(1);
    frame_.col(2) = frame_.col(0).cross(frame_.col(1));
    return true;
  }

  bool solve() {
    Eigen::Matrix3d normal_matrix = Eigen::Matrix3d::Zero();
    Vector3 right = Vector3::Zero();
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const Vector3 local = frame_.transpose() * (points_[i].position - centre_);
      const Vector3 row(1.0, local.x(), local.y());
      const double weight = points_[i].weight * robust_[i];
      normal_matrix += weight * row * row.transpose();
      right += weight * local.z() * row;
    }
    factor_.compute(normal_matrix);
    if (factor_.info() != Eigen::Success || !factor_.isPositive())
      return false;
    model_ = factor_.solve(right);
    residuals_.clear();
    for (const WeightedPoint& p : points_) {
      const Vector3 local = frame_.transpose() * (p.position - centre_);
      residuals_.push_back(std::abs(local.z() - Vector3(1.0, local.x(), local.y()).dot(model_)));
    }
    return model_.allFinite();
  }

  void weighByAbsolute() {
    for (std::size_t i = 0; i < points_.size(); ++i)
      robust_[i] = 1.0 / std::max(residuals_[i] / least_scale_, 0.1);
  }

  void weighByBiweight() {
    sorted_ = residuals_;
    const auto middle = sorted_.begin() + static_cast<std::ptrdiff_t>(sorted_.size() / 2);
    std::nth_element(sorted_.begin(), middle, sorted_.end());
    const double width =
        BIWEIGHT_WIDTH * std::max(least_scale_, DEVIATION_FROM_MEDIAN * *middle);
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const double share = residuals_[i] / width;
      robust_[i] = share < 1.0 ? (1.0 - share * share) * (1.0 - share * share) : 0.0;
    }
  }

  const std::vector<WeightedPoint>& points_;
  double least_scale_;
  Vector3 centre_ = Vector3::Zero();
  Eigen::Matrix3d frame_ = Eigen::Matrix3d::Identity();
  Eigen::LDLT<Eigen::Matrix3d> factor_;
  Vector3 model_ = Vector3::Zero(); ///< height, two slopes
  std::vector<double> robust_, residuals_, sorted_;
};

} // namespace

PlaneAt robustPlaneAt(const Vector3& query, const std::vector<WeightedPoint>& points,
                      double scale) {
  PlaneFit fit(points, scale);
  return fit.fit() ? fit.at(query) : PlaneAt();
}

} // namespace graben::detail
