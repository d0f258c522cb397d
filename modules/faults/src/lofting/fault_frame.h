#pragma once

#include "graben/core/median.h"
#include "graben/mesh/triangle_mesh.h"

namespace graben::detail {

/// Coordinates on a fault: s along its strike, t up its dip, w off it (towards its upward normal), all lengths. The plane behind them is the one that
/// most nodes lie near: a few that lie far off do not turn it.
class FaultFrame {
public:
  FaultFrame() = default;
  /// \param[in] nodes three or more finite points that are not all on a line
  explicit FaultFrame(const Points& nodes);

  /// The same with w counted along the level, for nodes that were digitised at given heights: their errors then do not show in t. Not where it is gentle.
  FaultFrame withLevelOffsets() const;

  Vector3 toFrame(const Vector3& p) const { return to_frame_ * (p - centre_); } ///< (s, t, w)
  Vector3 toSpace(const Vector3& stw) const { return centre_ + axes_ * stw; }
  /// Degrees, 0 to 90.
  double dip() const;

private:
  Eigen::Matrix3d axes_ = Eigen::Matrix3d::Identity(); ///< columns: strike, up dip, normal or level
  Eigen::Matrix3d to_frame_ = Eigen::Matrix3d::Identity();
  Vector3 centre_ = Vector3::Zero();
};

/// Standard deviation of values about 0, as the median tells it: a few wild ones do not count.
double robustDeviation(std::vector<double> values);

} // namespace graben::detail
