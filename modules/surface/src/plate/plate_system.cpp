#include "plate_system.h"

#include <Eigen/SparseCholesky>

#include <cmath>

namespace graben::detail {

namespace {

constexpr double kShorter = 0.25; // of the length by which change of bending is resisted: that by which bending itself is, or it would run away
constexpr double kTiny = 1e-9;    // of the largest diagonal: keeps what nothing holds where it is

using Matrix = Eigen::SparseMatrix<double>;

void steady(Matrix& matrix) {
  const double most = matrix.diagonal().maxCoeff();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i)
    matrix.coeffRef(i, i) += kTiny * most;
}

} // namespace

/// Rows in the making.
class PlateSystem::Rows {
public:
  explicit Rows(const PlateSystem& system) : system_(system) {}

  /// \return whether the node is one of those that move
  bool add(Index node, double weight) {
    const Eigen::Index at = system_.column_[static_cast<std::size_t>(node)];
    if (at >= 0)
      entries_.emplace_back(static_cast<Eigen::Index>(right_.size()), at, weight);
    return at >= 0;
  }
  /// One of the second derivatives at a stencil. \return what it is now
  double add(const PlateStencil& stencil, std::size_t derivative, double factor) {
    for (std::size_t i = 0; i < stencil.nodes.size(); ++i)
      add(stencil.nodes[i], factor * stencil.weights[derivative][i]);
    return factor * stencil.bend[derivative];
  }
  void end(double right) { right_.push_back(right); }

  Normal normal() const {
    Eigen::SparseMatrix<double, Eigen::RowMajor> rows(static_cast<Eigen::Index>(right_.size()), static_cast<Eigen::Index>(system_.active_.size()));
    rows.setFromTriplets(entries_.begin(), entries_.end());
    Normal result;
    result.matrix = Eigen::SparseMatrix<double>(rows.transpose()) * Eigen::SparseMatrix<double>(rows);
    result.right = rows.transpose() * Eigen::Map<const Eigen::VectorXd>(right_.data(), static_cast<Eigen::Index>(right_.size()));
    return result;
  }

private:
  const PlateSystem& system_;
  std::vector<Eigen::Triplet<double>> entries_;
  std::vector<double> right_;
};

PlateSystem::PlateSystem(const PlateParts& parts, std::vector<Index> active)
  : active_(std::move(active)), column_(parts.nodes.count(), -1), density_(parts.density), tip_length_(parts.tip_length) {
  for (std::size_t i = 0; i < active_.size(); ++i)
    column_[static_cast<std::size_t>(active_[i])] = static_cast<Eigen::Index>(i);
  held_ = springs(parts, false);
  left_out_ = springs(parts, true);
  bending_ = bending(parts, false);
  bending_at_tips_ = bending(parts, true);
  changes_ = changes(parts);
}

PlateSystem::Normal PlateSystem::springs(const PlateParts& parts, bool left_out) const {
  Rows rows(*this);
  for (const PlateSpring& s : parts.springs) {
    if (s.left_out != left_out)
      continue;
    bool any = false;
    for (const NodeShare& n : s.foot.shares)
      any = rows.add(n.node, n.share) || any;
    if (any)
      rows.end(s.distance - s.foot.height);
  }
  return rows.normal();
}

PlateSystem::Normal PlateSystem::bending(const PlateParts& parts, bool at_tip) const {
  Rows rows(*this);
  for (const Index node : active_) {
    const auto n = static_cast<std::size_t>(node);
    const PlateStencil& stencil = parts.stencils[n];
    if (stencil.nodes.empty() || (parts.at_tip[n] != 0) != at_tip)
      continue;
    for (std::size_t k = 0; k < 3; ++k)
      rows.end(-rows.add(stencil, k, std::sqrt(parts.nodes.area[n])));
  }
  return rows.normal();
}

PlateSystem::Normal PlateSystem::changes(const PlateParts& parts) const {
  Rows rows(*this);
  for (const StiffEdge& edge : parts.edges) {
    const auto a = static_cast<std::size_t>(edge.nodes[0]);
    const auto b = static_cast<std::size_t>(edge.nodes[1]);
    if ((column_[a] < 0 && column_[b] < 0) || parts.at_tip[a] != 0 || parts.at_tip[b] != 0)
      continue;
    for (std::size_t k = 0; k < 3; ++k) {
      double now = rows.add(parts.stencils[a], k, edge.weight);
      for (std::size_t from = 0; from < 3; ++from)
        now += rows.add(parts.stencils[b], from, -edge.weight * edge.turned[k][from]);
      rows.end(-now);
    }
  }
  return rows.normal();
}

Eigen::VectorXd PlateSystem::moves(const PlateStiffness& stiffness, HeldBy held) const {
  const bool third = stiffness.order == 3;
  const double left_out = held == HeldBy::All ? 1.0 : 0.0;
  const double bend = density_ * std::pow((third ? kShorter : 1.0) * stiffness.length, 4);
  const double bend_at_tips = density_ * std::pow(third ? tip_length_ : stiffness.length, 4);
  const double change = third ? density_ * std::pow(stiffness.length, 6) : 0.0;
  Matrix matrix = held_.matrix + left_out * left_out_.matrix + bend * bending_.matrix + bend_at_tips * bending_at_tips_.matrix;
  if (third)
    matrix += change * changes_.matrix;
  const Eigen::VectorXd right =
    held_.right + left_out * left_out_.right + bend * bending_.right + bend_at_tips * bending_at_tips_.right + change * changes_.right;
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

} // namespace graben::detail
