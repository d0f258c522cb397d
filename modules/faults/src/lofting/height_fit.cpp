#include "lofting/height_fit.h"

#include "lofting/fault_frame.h"

#include "graben/mesh/bounds.h"

#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>

namespace graben::detail {
namespace {

constexpr Index kFewest = 4;      // nodes of the grid in either direction
constexpr double kHuber = 2.0;    // deviations beyond which a point counts less
constexpr int kRobustRounds = 5;
constexpr double kShortest = 0.4; // of the grid's step
constexpr double kLadder = 1.6;   // from one length to the next

} // namespace

HeightGrid::HeightGrid(const Points& stw, std::size_t unknowns) {
  const Bounds box = boundsOf(stw);
  const Vector3 size = box.size();
  const double longer = std::max(size.x(), size.y());
  step_ = std::max(std::sqrt(std::max(size.x(), 1e-3 * longer) * std::max(size.y(), 1e-3 * longer) / static_cast<double>(unknowns)),
                   2.0 * longer / static_cast<double>(unknowns));
  if (!(step_ > 0.0))
    step_ = 1.0;
  const auto count = [this](double length) { return std::max(kFewest, static_cast<Index>(std::ceil(length / step_)) + 1); };
  columns_ = count(size.x());
  rows_ = count(size.y());
  low_s_ = box.low.x() - 0.5 * (step_ * static_cast<double>(columns_ - 1) - size.x());
  low_t_ = box.low.y() - 0.5 * (step_ * static_cast<double>(rows_ - 1) - size.y());
}

HeightGrid::Place HeightGrid::place(double s, double t) const {
  const auto cell = [this](double x, Index count) {
    return std::min(count - 2, static_cast<Index>(std::max(0.0, std::floor(std::min(x, static_cast<double>(count))))));
  };
  const double x = (s - low_s_) / step_;
  const double y = (t - low_t_) / step_;
  const Index i = cell(x, columns_);
  const Index j = cell(y, rows_);
  const double u = x - static_cast<double>(i);
  const double v = y - static_cast<double>(j);
  const Index n = j * columns_ + i;
  return {{n, n + 1, n + columns_, n + columns_ + 1}, {(1.0 - u) * (1.0 - v), u * (1.0 - v), (1.0 - u) * v, u * v}};
}

double HeightGrid::at(double s, double t) const {
  const Place p = place(s, t);
  double w = 0.0;
  for (std::size_t k = 0; k < 4; ++k)
    w += p.share[k] * values_[static_cast<std::size_t>(p.node[k])];
  return w;
}

HeightFitter::HeightFitter(Points stw, std::size_t unknowns) : stw_(std::move(stw)), grid_(stw_, unknowns) {}

HeightGrid HeightFitter::fit(const std::vector<double>& weights, double length) const {
  const Index nodes = grid_.columns_ * grid_.rows_;
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd right = Eigen::VectorXd::Zero(nodes);
  double all = 0.0;
  for (const double w : weights)
    all += w;
  for (std::size_t i = 0; i < stw_.size(); ++i) {
    if (weights[i] == 0.0)
      continue;
    const HeightGrid::Place p = grid_.place(stw_[i].x(), stw_[i].y());
    for (std::size_t a = 0; a < 4; ++a) {
      right[p.node[a]] += weights[i] / all * p.share[a] * stw_[i].z();
      for (std::size_t b = 0; b < 4; ++b)
        if (p.node[b] <= p.node[a])
          entries.emplace_back(p.node[a], p.node[b], weights[i] / all * p.share[a] * p.share[b]);
    }
  }
  const double stiffness = std::pow(length / grid_.step_, 4) / static_cast<double>(nodes);
  const auto bend = [&](std::initializer_list<std::pair<Index, double>> stencil, double factor) {
    for (const auto& [a, x] : stencil)
      for (const auto& [b, y] : stencil)
        if (b <= a)
          entries.emplace_back(a, b, factor * stiffness * x * y);
  };
  const Index n = grid_.columns_;
  for (Index j = 0; j < grid_.rows_; ++j)
    for (Index i = 0; i < n; ++i) {
      const Index at = j * n + i;
      if (i > 0 && i + 1 < n)
        bend({{at - 1, 1.0}, {at, -2.0}, {at + 1, 1.0}}, 1.0);
      if (j > 0 && j + 1 < grid_.rows_)
        bend({{at - n, 1.0}, {at, -2.0}, {at + n, 1.0}}, 1.0);
      if (i + 1 < n && j + 1 < grid_.rows_)
        bend({{at, 1.0}, {at + 1, -1.0}, {at + n, -1.0}, {at + n + 1, 1.0}}, 2.0);
    }
  Eigen::SparseMatrix<double> matrix(nodes, nodes);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> solver(matrix);
  const Eigen::VectorXd values = solver.solve(right);
  HeightGrid result = grid_;
  result.values_.assign(values.data(), values.data() + values.size());
  return result;
}

HeightGrid HeightFitter::fitRobustly(double length) const {
  std::vector<double> weights(stw_.size(), 1.0);
  HeightGrid grid = fit(weights, length);
  for (int round = 0; round < kRobustRounds; ++round) {
    const std::vector<double> off = residuals(grid);
    const double reach = kHuber * robustDeviation(off);
    bool wild = false;
    for (std::size_t i = 0; i < off.size(); ++i) {
      weights[i] = std::abs(off[i]) <= reach || reach == 0.0 ? 1.0 : reach / std::abs(off[i]);
      wild = wild || weights[i] < 0.5;
    }
    if (!wild)
      break;
    grid = fit(weights, length);
  }
  return grid;
}

std::vector<double> HeightFitter::residuals(const HeightGrid& grid) const {
  std::vector<double> off;
  off.reserve(stw_.size());
  for (const Vector3& p : stw_)
    off.push_back(p.z() - grid.at(p.x(), p.y()));
  return off;
}

std::vector<double> HeightFitter::lengths() const {
  std::vector<double> lengths;
  const double longest = 2.0 * grid_.step_ * static_cast<double>(std::max(grid_.columns_, grid_.rows_));
  for (double length = kShortest * grid_.step_; length < longest; length *= kLadder)
    lengths.push_back(length);
  return lengths;
}

std::vector<double> HeightFitter::leftOutErrors(const std::vector<double>& lengths, const std::vector<int>& fold, int folds) const {
  std::vector<double> errors;
  for (const double length : lengths) {
    double sum = 0.0;
    double count = 0.0;
    for (int f = 0; f < folds; ++f) {
      std::vector<double> weights(stw_.size(), 1.0);
      for (std::size_t i = 0; i < fold.size(); ++i)
        if (fold[i] == f)
          weights[i] = 0.0;
      const HeightGrid grid = fit(weights, length);
      for (std::size_t i = 0; i < fold.size(); ++i)
        if (fold[i] == f) {
          sum += std::abs(stw_[i].z() - grid.at(stw_[i].x(), stw_[i].y()));
          count += 1.0;
        }
    }
    errors.push_back(count > 0.0 ? sum / count : 0.0);
  }
  return errors;
}

} // namespace graben::detail
