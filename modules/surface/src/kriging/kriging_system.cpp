#include "kriging_system.h"

#include "supernodal_cholesky.h"

#include <cmath>

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
      addAt(at, weight);
    return at >= 0;
  }
  void addAt(Eigen::Index column, double weight) { entries_.emplace_back(static_cast<Eigen::Index>(right_.size()), column, weight); }
  void end(double right) { right_.push_back(right); }

  Normal normal() const {
    Eigen::SparseMatrix<double, Eigen::RowMajor> rows(static_cast<Eigen::Index>(right_.size()), system_.columns());
    rows.setFromTriplets(entries_.begin(), entries_.end());
    const Eigen::Map<const Eigen::VectorXd> right(right_.data(), static_cast<Eigen::Index>(right_.size()));
    return {Matrix(rows.transpose()) * Matrix(rows), rows.transpose() * right};
  }

private:
  const KrigingSystem& system_;
  std::vector<Eigen::Triplet<double>> entries_;
  std::vector<double> right_;
};

KrigingSystem::KrigingSystem(const std::vector<KrigedPick>& picks, const std::vector<std::vector<LineShare>>& lines, std::vector<Index> active, KrigedRows rows,
                             std::size_t count)
  : active_(std::move(active)), column_(count, -1), rows_(std::move(rows)) {
  for (std::size_t i = 0; i < active_.size(); ++i)
    column_[static_cast<std::size_t>(active_[i])] = static_cast<Eigen::Index>(i);
  picks_ = ofPicks(picks, lines);
}

/// A line takes a column where the first of its picks holds one of the nodes.
KrigingSystem::Normal KrigingSystem::ofPicks(const std::vector<KrigedPick>& picks, const std::vector<std::vector<LineShare>>& lines) {
  Rows rows(*this);
  for (std::size_t i = 0; i < picks.size(); ++i) {
    const NodeBlend& foot = picks[i].foot;
    bool any = false;
    for (const NodeShare& n : foot.shares)
      any = rows.add(n.node, n.share) || any;
    if (!any)
      continue;
    if (!lines.empty())
      for (const LineShare& l : lines[i])
        rows.addAt(line_column_.try_emplace(l.line, static_cast<Eigen::Index>(active_.size() + line_column_.size())).first->second, l.share);
    rows.end(picks[i].distance - foot.height);
  }
  return rows.normal();
}

KrigingSystem::Normal KrigingSystem::ofHeights(const SurfaceCorrelation& correlation) const {
  Rows rows(*this);
  for (const KrigedRow& told : rows_.rows(correlation)) {
    const double weight = correlation.noise / std::sqrt(told.variance);
    for (const NodeShare& s : told.shares)
      rows.add(s.node, weight * s.share);
    rows.end(-weight * told.height);
  }
  for (const auto& [line, column] : line_column_) {
    rows.addAt(column, correlation.noise / correlation.mistie);
    rows.end(0.0);
  }
  return rows.normal();
}

Eigen::VectorXd KrigingSystem::moves(const SurfaceCorrelation& correlation) const {
  const Normal heights = ofHeights(correlation);
  Matrix matrix = heights.matrix + picks_.matrix;
  const Eigen::VectorXd right = heights.right + picks_.right;
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(right.size());
  if (matrix.rows() == 0 || !(matrix.diagonal().maxCoeff() > 0.0))
    return none;
  steady(matrix);
  const SupernodalCholesky factor(matrix);
  if (!factor.ok())
    return none;
  const Eigen::VectorXd found = factor.solve(right);
  return found.allFinite() ? found : none;
}

} // namespace graben::detail
