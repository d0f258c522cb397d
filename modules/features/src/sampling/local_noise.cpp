#include "sampling/local_noise.h"

#include <Eigen/Geometry>
#include <Eigen/QR>

#include <limits>

namespace graben::detail {
namespace {

/// Sum of squared residuals over the degrees of freedom left.
template <int Terms>
double residualVariance(const Eigen::Matrix<double, Eigen::Dynamic, Terms>& design,
                        const Eigen::VectorXd& heights) {
  if (design.rows() < Terms + 3)
    return std::numeric_limits<double>::quiet_NaN();
  const Eigen::ColPivHouseholderQR<Eigen::Matrix<double, Eigen::Dynamic, Terms>> qr(design);
  if (qr.rank() < Terms)
    return std::numeric_limits<double>::quiet_NaN();
  const Eigen::VectorXd residuals = heights - design * qr.solve(heights);
  return residuals.squaredNorm() / static_cast<double>(design.rows() - Terms);
}

} // namespace

Eigen::Matrix3d frameAbout(const Vector3& normal) {
  Eigen::Matrix3d frame;
  frame.col(2) = normal;
  frame.col(0) = normal.unitOrthogonal();
  frame.col(1) = normal.cross(frame.col(0));
  return frame;
}

LocalNoise localNoise(const Points& points, const std::vector<Index>& neighbors,
                      const Vector3& origin, const Eigen::Matrix3d& frame) {
  const auto count = static_cast<Eigen::Index>(neighbors.size());
  Eigen::Matrix<double, Eigen::Dynamic, 6> design(count, 6);
  Eigen::VectorXd heights(count);
  double scale = 0.0;
  for (const Index n : neighbors)
    scale = std::max(scale, (points[static_cast<std::size_t>(n)] - origin).norm());
  for (Eigen::Index row = 0; row < count; ++row) {
    const Vector3 local =
        frame.transpose() *
        (points[static_cast<std::size_t>(neighbors[static_cast<std::size_t>(row)])] - origin) /
        scale;
    design.row(row) << 1.0, local.x(), local.y(), local.x() * local.x(), local.x() * local.y(),
        local.y() * local.y();
    heights[row] = local.z();
  }
  const Eigen::Matrix<double, Eigen::Dynamic, 3> plane = design.leftCols<3>();
  const double squared_scale = scale * scale;
  return {residualVariance<3>(plane, heights) * squared_scale,
          residualVariance<6>(design, heights) * squared_scale};
}

} // namespace graben::detail
