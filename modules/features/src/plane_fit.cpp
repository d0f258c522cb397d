#include "plane_fit.h"

#include <Eigen/Eigenvalues>

namespace graben::detail {
namespace {

constexpr double LINE =
    1e-10; ///< ratio of the second to the largest eigenvalue below which points lie on a line

} // namespace

std::optional<FittedPlane> fitPlane(const Points& points, const std::vector<Index>& indices) {
  if (indices.size() < 3)
    return std::nullopt;
  const Vector3 origin = points[static_cast<std::size_t>(indices.front())];
  const double count = static_cast<double>(indices.size());
  Vector3 mean = Vector3::Zero();
  for (const Index i : indices)
    mean += points[static_cast<std::size_t>(i)] - origin;
  mean /= count;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const Index i : indices) {
    const Vector3 d = points[static_cast<std::size_t>(i)] - origin - mean;
    covariance(0, 0) += d.x() * d.x();
    covariance(1, 0) += d.y() * d.x();
    covariance(2, 0) += d.z() * d.x();
    covariance(1, 1) += d.y() * d.y();
    covariance(2, 1) += d.z() * d.y();
    covariance(2, 2) += d.z() * d.z();
  }
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(covariance);
  // The closed form loses half the digits of two eigenvalues that are nearly the same.
  if (!(solver.eigenvalues()[1] > 1e-4 * solver.eigenvalues()[2]))
    solver.compute(covariance);
  const Vector3 values = solver.eigenvalues();
  if (!(values[2] > 0.0) || !(values[1] > LINE * values[2]))
    return std::nullopt;
  const Vector3 normal = solver.eigenvectors().col(0).normalized();
  if (!normal.allFinite())
    return std::nullopt;
  return FittedPlane{origin + mean, normal,
                     std::max(0.0, values[0]) / (std::max(0.0, values[0]) + values[1] + values[2])};
}

} // namespace graben::detail
