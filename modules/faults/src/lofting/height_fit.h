#pragma once

#include "graben/mesh/triangle_mesh.h"

#include <vector>

namespace graben::detail {

/// Heights w over a rectangle of (s, t), bilinear between the nodes of a grid.
class HeightGrid {
public:
  HeightGrid() = default;
  /// A grid of about \a unknowns nodes over the points' s and t.
  HeightGrid(const Points& stw, std::size_t unknowns);

  double at(double s, double t) const;
  double step() const { return step_; }

private:
  friend class HeightFitter;

  /// The four nodes around a place and their shares.
  struct Place {
    std::array<Index, 4> node;
    std::array<double, 4> share;
  };
  Place place(double s, double t) const;

  double low_s_ = 0.0, low_t_ = 0.0, step_ = 1.0;
  Index columns_ = 2, rows_ = 2;
  std::vector<double> values_;
};

/// Fits heights to scattered ones: least squares with a penalty on the mean squared second derivatives (a thin plate), whose weight is the fourth power
/// of a length: what is smaller than that length is smoothed away. Nothing tends to bend a plane.
class HeightFitter {
public:
  HeightFitter(Points stw, std::size_t unknowns);

  /// \param[in] weights one a point, 0: left out
  HeightGrid fit(const std::vector<double>& weights, double length) const;

  /// With points that lie far off for their number counting less (Huber's weights).
  HeightGrid fitRobustly(double length) const;

  std::vector<double> residuals(const HeightGrid& grid) const;
  std::size_t size() const { return stw_.size(); }

  /// Lengths worth trying, from next to none to one that leaves hardly more than a plane.
  std::vector<double> lengths() const;

  /// The mean distance from points to what is fitted without them, for each length: groups are left out whole.
  /// \param[in] fold of each point, -1: never left out
  std::vector<double> leftOutErrors(const std::vector<double>& lengths, const std::vector<int>& fold, int folds) const;

private:
  Points stw_;
  HeightGrid grid_;
};

} // namespace graben::detail
