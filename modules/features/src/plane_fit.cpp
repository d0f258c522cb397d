#include "plane_fit.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace graben::detail {
namespace {

constexpr double LINE =
    1e-10; ///< ratio of the second to the largest eigenvalue below which points lie on a line

/// The eigenvector of the least eigenvalue, where the points make a clear plane: that value is well below the others, which are alike within
/// 1e-4. False if they do not; a general solver then knows what to do.
bool leastEigenvector(const Eigen::Matrix3d& m, Vector3& vector, double& least, double& sum) {
  const double a = m(0, 0), b = m(1, 1), c = m(2, 2), d = m(1, 0), e = m(2, 0), f = m(2, 1);
  const double minors = a * b - d * d + a * c - e * e + b * c - f * f;
  const double determinant = a * (b * c - f * f) - d * (d * c - f * e) + e * (d * f - b * e);
  sum = a + b + c;
  if (!(minors > 2e-4 * sum * sum)) // the product of the others over their squared sum
    return false;
  // Newton's steps from 0 grow towards the least root of the characteristic polynomial and never beyond it.
  least = 0.0;
  for (int step = 0; step < 8; ++step) {
    const double value = determinant - least * (minors - least * (sum - least));
    const double slope = minors - least * (2.0 * sum - 3.0 * least);
    const double change = value / slope;
    least += change;
    if (std::abs(change) <= 1e-16 * sum)
      break;
  }
  if (!(8.0 * least < sum) || !(least > -1e-12 * sum))
    return false;
  const Vector3 x(a - least, d, e), y(d, b - least, f), z(e, f, c - least);
  const Vector3 xy = x.cross(y), xz = x.cross(z), yz = y.cross(z);
  const double xy2 = xy.squaredNorm(), xz2 = xz.squaredNorm(), yz2 = yz.squaredNorm();
  const double most = std::max({xy2, xz2, yz2});
  vector = most == xy2 ? xy : most == xz2 ? xz : yz;
  vector /= std::sqrt(most);
  return most > 1e-8 * sum * sum * sum * sum;
}

} // namespace

Scatter scatterOf(const Points& points, const std::vector<Index>& indices) {
  const Vector3 origin = points[static_cast<std::size_t>(indices.front())]; // near: little is lost in the differences of sums below
  double x = 0.0, y = 0.0, z = 0.0, xx = 0.0, yx = 0.0, zx = 0.0, yy = 0.0, zy = 0.0, zz = 0.0, farthest = 0.0;
  for (const Index i : indices) {
    const Vector3& p = points[static_cast<std::size_t>(i)];
    const double dx = p.x() - origin.x(), dy = p.y() - origin.y(), dz = p.z() - origin.z();
    x += dx;
    y += dy;
    z += dz;
    const double dx2 = dx * dx, dy2 = dy * dy, dz2 = dz * dz;
    xx += dx2;
    yy += dy2;
    zz += dz2;
    yx += dy * dx;
    zx += dz * dx;
    zy += dz * dy;
    farthest = std::max(farthest, dx2 + dy2 + dz2);
  }
  const double share = 1.0 / static_cast<double>(indices.size());
  Scatter scatter;
  scatter.centre = origin + share * Vector3(x, y, z);
  scatter.sum << xx - share * x * x, 0.0, 0.0, yx - share * y * x, yy - share * y * y, 0.0, zx - share * z * x, zy - share * z * y,
      zz - share * z * z;
  scatter.farthest = farthest;
  return scatter;
}

std::optional<FittedPlane> fitPlane(const Scatter& scatter, const Eigen::Matrix3d* pull) {
  Vector3 quick;
  double least = 0.0, all_values = 0.0;
  if (pull == nullptr && leastEigenvector(scatter.sum, quick, least, all_values))
    return FittedPlane{scatter.centre, quick, std::max(0.0, least) / all_values};
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
