#include "kriging_system.h"

#include <Eigen/SparseCholesky>

#include <cmath>
#include <limits>

namespace graben::detail {

namespace {

constexpr double kTiny = 1e-9; // of the largest diagonal: keeps what nothing holds where it is

using Matrix = Eigen::SparseMatrix<double>;

void steady(Matrix& matrix) {
  const double most = matrix.diagonal().maxCoeff();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i)
    matrix.coeffRef(i, i) += kTiny * most;
}

} // namespace

/// Rows in the making.
class KrigingSystem::Rows {
public:
  explicit Rows(const KrigingSystem& system) : system_(system) {}

  /// \return whether the node is one of those that move
  bool add(Index node, double weight) {
    const Eigen::Index at = system_.column_[static_cast<std::size_t>(node)];
    if (at >= 0)
      entries_.emplace_back(static_cast<Eigen::Index>(right_.size()), at, weight);
    return at >= 0;
  }
  void end(double right) { right_.push_back(right); }

  Normal normal() const {
    Eigen::SparseMatrix<double, Eigen::RowMajor> rows(static_cast<Eigen::Index>(right_.size()), static_cast<Eigen::Index>(system_.active_.size()));
    rows.setFromTriplets(entries_.begin(), entries_.end());
    const Eigen::Map<const Eigen::VectorXd> right(right_.data(), static_cast<Eigen::Index>(right_.size()));
    return {Matrix(rows.transpose()) * Matrix(rows), rows.transpose() * right, right.squaredNorm(), right.size()};
  }

private:
  const KrigingSystem& system_;
  std::vector<Eigen::Triplet<double>> entries_;
  std::vector<double> right_;
};

KrigingSystem::KrigingSystem(const std::vector<KrigedPick>& picks, std::vector<Index> active, KrigedRows rows, std::size_t count)
  : active_(std::move(active)), column_(count, -1), rows_(std::move(rows)) {
  for (std::size_t i = 0; i < active_.size(); ++i)
    column_[static_cast<std::size_t>(active_[i])] = static_cast<Eigen::Index>(i);
  picks_ = ofPicks(picks);
}

KrigingSystem::Normal KrigingSystem::ofPicks(const std::vector<KrigedPick>& picks) const {
  Rows rows(*this);
  for (const KrigedPick& pick : picks) {
    bool any = false;
    for (const NodeShare& n : pick.foot.shares)
      any = rows.add(n.node, n.share) || any;
    if (any)
      rows.end(pick.distance - pick.foot.height);
  }
  return rows.normal();
}

KrigingSystem::Normal KrigingSystem::ofHeights(const SurfaceCorrelation& correlation, double& log_determinant) const {
  Rows rows(*this);
  log_determinant = 0.0;
  for (const KrigedRow& told : rows_.rows(correlation.correlation, correlation.length)) {
    const double weight = correlation.noise / std::sqrt(told.variance);
    for (const NodeShare& s : told.shares)
      rows.add(s.node, weight * s.share);
    rows.end(-weight * told.height);
    log_determinant += 2.0 * std::log(weight);
  }
  return rows.normal();
}

Eigen::VectorXd KrigingSystem::moves(const SurfaceCorrelation& correlation) const {
  double log_determinant = 0.0;
  const Normal heights = ofHeights(correlation, log_determinant);
  Matrix matrix = heights.matrix + picks_.matrix;
  const Eigen::VectorXd right = heights.right + picks_.right;
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(right.size());
  if (matrix.rows() == 0 || !(matrix.diagonal().maxCoeff() > 0.0))
    return none;
  steady(matrix);
  const Eigen::SimplicialLDLT<Matrix> factor(matrix);
  if (factor.info() != Eigen::Success)
    return none;
  const Eigen::VectorXd found = factor.solve(right);
  return found.allFinite() ? found : none;
}

/// With the variance of the picks' noise as what the distances themselves tell.
double KrigingSystem::unlikeliness(const SurfaceCorrelation& correlation) const {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  double log_prior = 0.0;
  const Normal heights = ofHeights(correlation, log_prior);
  const Matrix matrix = heights.matrix + picks_.matrix;
  if (matrix.rows() == 0 || picks_.count == 0)
    return kNone;
  const Eigen::SimplicialLDLT<Matrix> factor(matrix);
  if (factor.info() != Eigen::Success || !(factor.vectorD().minCoeff() > 0.0))
    return kNone;
  const Eigen::VectorXd right = heights.right + picks_.right;
  const auto count = static_cast<double>(picks_.count);
  const double rest = heights.squares + picks_.squares - right.dot(factor.solve(right));
  return rest > 0.0 ? count * std::log(rest / count) + factor.vectorD().array().log().sum() - log_prior : kNone;
}

} // namespace graben::detail
