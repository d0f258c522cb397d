#include "planes/plane_fit.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace graben::detail {
namespace {

constexpr double LINE =
    1e-10; ///< ratio of the second to the largest eigenvalue below which points lie on a line

struct Solution {
  Vector3 normal;
  double share; ///< of the least eigenvalue in the sum of all
};

/// For any points; nothing if they lie on a line.
std::optional<Solution> solve(const Eigen::Matrix3d& matrix) {
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(matrix);
  // The closed form loses half the digits of two eigenvalues that are nearly the same.
  if (!(solver.eigenvalues()[1] > 1e-4 * solver.eigenvalues()[2]))
    solver.compute(matrix);
  const Vector3 values = solver.eigenvalues();
  const Vector3 normal = solver.eigenvectors().col(0).normalized();
  if (!(values[2] > 0.0) || !(values[1] > LINE * values[2]) || !normal.allFinite())
    return std::nullopt;
  const double least = std::max(0.0, values[0]);
  return Solution{normal, least / (least + values[1] + values[2])};
}

} // namespace

Eigen::Matrix3d Scatter::matrix() const {
  Eigen::Matrix3d m;
  m << sum.xx, 0.0, 0.0, sum.yx, sum.yy, 0.0, sum.zx, sum.zy, sum.zz;
  return m;
}

Scatter scatterOf(const Vector3& place, const Moments& m, std::size_t count) {
  const double share = 1.0 / static_cast<double>(count);
  Scatter scatter;
  scatter.centre = place + share * Vector3(m.x, m.y, m.z);
  scatter.sum.xx = m.xx - share * m.x * m.x;
  scatter.sum.yx = m.yx - share * m.y * m.x;
  scatter.sum.yy = m.yy - share * m.y * m.y;
  scatter.sum.zx = m.zx - share * m.z * m.x;
  scatter.sum.zy = m.zy - share * m.z * m.y;
  scatter.sum.zz = m.zz - share * m.z * m.z;
  scatter.farthest = m.farthest;
  return scatter;
}

Scatter scatterOf(const Points& points, const std::vector<Index>& indices) {
  static thread_local std::vector<Index> sorted;
  static thread_local VectorArrays vectors;
  const Vector3& first = points[static_cast<std::size_t>(indices.front())]; // near: little is lost in the differences of sums
  sorted.assign(indices.begin() + 1, indices.end());
  std::sort(sorted.begin(), sorted.end());
  vectors.makeRoomFor(sorted.size());
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    const Vector3 d = points[static_cast<std::size_t>(sorted[i])] - first;
    vectors.x[i] = d.x();
    vectors.y[i] = d.y();
    vectors.z[i] = d.z();
  }
  return scatterOf(first, vectors.moments(sorted.size()), indices.size());
}

std::optional<FittedPlane> fitPlane(const Scatter& scatter, const Eigen::Matrix3d& pull) {
  const std::optional<Solution> solution = solve(scatter.matrix() + pull);
  if (!solution)
    return std::nullopt;
  const Eigen::Matrix3d spread = scatter.matrix();
  const double across = solution->normal.dot(spread.selfadjointView<Eigen::Lower>() * solution->normal);
  const double all = spread.trace();
  return FittedPlane{scatter.centre, solution->normal, all > 0.0 ? std::min(std::max(0.0, across) / all, 1.0 / 3.0) : 0.0};
}

void fitPlanes(const Scatter* scatters, std::size_t count, std::optional<FittedPlane>* planes) {
  static thread_local std::vector<SymmetricMatrix> sums;
  static thread_local std::vector<LeastEigenvector> vectors;
  sums.clear();
  for (std::size_t i = 0; i < count; ++i)
    sums.push_back(scatters[i].sum);
  vectors.resize(count);
  leastEigenvectors(sums.data(), count, vectors.data());
  for (std::size_t i = 0; i < count; ++i) {
    const LeastEigenvector& v = vectors[i];
    planes[i].reset();
    if (v.clear)
      planes[i] = FittedPlane{scatters[i].centre, {v.x, v.y, v.z}, v.share};
    else if (const std::optional<Solution> solution = solve(scatters[i].matrix()))
      planes[i] = FittedPlane{scatters[i].centre, solution->normal, solution->share};
  }
}

std::optional<FittedPlane> fitPlane(const Scatter& scatter) {
  std::optional<FittedPlane> plane;
  fitPlanes(&scatter, 1, &plane);
  return plane;
}

std::optional<FittedPlane> fitPlane(const Points& points, const std::vector<Index>& indices) {
  if (indices.size() < 3)
    return std::nullopt;
  return fitPlane(scatterOf(points, indices));
}

} // namespace graben::detail
