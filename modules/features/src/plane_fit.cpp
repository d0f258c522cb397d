#include "plane_fit.h"

#include <Eigen/Eigenvalues>

namespace graben::detail {
namespace {

constexpr double LINE =
    1e-10; ///< ratio of the second to the largest eigenvalue below which points lie on a line

} // namespace

Scatter scatterOf(const Points& points, const std::vector<Index>& indices) {
  Scatter scatter;
  const Vector3 origin = points[static_cast<std::size_t>(indices.front())];
  Vector3 mean = Vector3::Zero();
  for (const Index i : indices)
    mean += points[static_cast<std::size_t>(i)] - origin;
  mean /= static_cast<double>(indices.size());
  Eigen::Matrix3d& sum = scatter.sum;
  for (const Index i : indices) {
    const Vector3 d = points[static_cast<std::size_t>(i)] - origin - mean;
    sum(0, 0) += d.x() * d.x();
    sum(1, 0) += d.y() * d.x();
    sum(2, 0) += d.z() * d.x();
    sum(1, 1) += d.y() * d.y();
    sum(2, 1) += d.z() * d.y();
    sum(2, 2) += d.z() * d.z();
  }
  scatter.centre = origin + mean;
  return scatter;
}

std::optional<FittedPlane> fitPlane(const Scatter& scatter, const Eigen::Matrix3d* pull) {
  const Eigen::Matrix3d matrix = pull == nullptr ? scatter.sum : Eigen::Matrix3d(scatter.sum + *pull);
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(matrix);
  // The closed form loses half the digits of two eigenvalues that are nearly the same.
  if (!(solver.eigenvalues()[1] > 1e-4 * solver.eigenvalues()[2]))
    solver.compute(matrix);
  const Vector3 values = solver.eigenvalues();
  if (!(values[2] > 0.0) || !(values[1] > LINE * values[2]))
    return std::nullopt;
  const Vector3 normal = solver.eigenvectors().col(0).normalized();
  if (!normal.allFinite())
    return std::nullopt;
  if (pull == nullptr)
    return FittedPlane{scatter.centre, normal, std::max(0.0, values[0]) / (std::max(0.0, values[0]) + values[1] + values[2])};
  const double across = normal.dot(scatter.sum.selfadjointView<Eigen::Lower>() * normal);
  const double all = scatter.sum.trace();
  return FittedPlane{scatter.centre, normal, all > 0.0 ? std::min(std::max(0.0, across) / all, 1.0 / 3.0) : 0.0};
}

std::optional<FittedPlane> fitPlane(const Points& points, const std::vector<Index>& indices) {
  if (indices.size() < 3)
    return std::nullopt;
  return fitPlane(scatterOf(points, indices));
}

} // namespace graben::detail
