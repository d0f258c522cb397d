#include "supernodal_cholesky.h"

#include <Eigen/Cholesky>
#include <Eigen/OrderingMethods>

#include <algorithm>
#include <utility>

namespace graben::detail {

namespace {

using Matrix = Eigen::SparseMatrix<double>;
using Column = Matrix::StorageIndex;
using Permutation = Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, Column>;

constexpr double kZeros = 0.2;  // of a supernode's factor that may be zeros, so that it is wider
constexpr Column kNarrow = 8;   // columns: as narrow a one may hold more of them
constexpr double kZerosOfNarrow = 0.5;

Matrix lowerOf(const Matrix& matrix, const Permutation& to_ordered) {
  Matrix lower(matrix.rows(), matrix.cols());
  lower.selfadjointView<Eigen::Lower>() = matrix.selfadjointView<Eigen::Lower>().twistedBy(to_ordered);
  return lower;
}

/// \return of each column the next that is told from it (Liu, ACM Trans. Math. Softw. 12, 1986)
std::vector<Column> eliminationTree(const Matrix& lower) {
  const auto count = static_cast<Column>(lower.cols());
  std::vector<std::vector<Column>> row(static_cast<std::size_t>(count));
  for (Column j = 0; j < count; ++j)
    for (Matrix::InnerIterator it(lower, j); it; ++it)
      if (it.row() > j)
        row[static_cast<std::size_t>(it.row())].push_back(j);
  std::vector<Column> parent(static_cast<std::size_t>(count), -1), top(static_cast<std::size_t>(count), -1);
  for (Column i = 0; i < count; ++i)
    for (Column j : row[static_cast<std::size_t>(i)])
      while (j >= 0 && j != i) {
        const Column next = std::exchange(top[static_cast<std::size_t>(j)], i);
        if (next < 0)
          parent[static_cast<std::size_t>(j)] = i;
        j = next;
      }
  return parent;
}

/// \return the columns of a tree such that all below one come right before it
std::vector<Column> postorder(const std::vector<Column>& parent) {
  const std::size_t count = parent.size();
  std::vector<std::vector<Column>> children(count + 1); // the last: the roots
  for (std::size_t j = 0; j < count; ++j)
    children[parent[j] < 0 ? count : static_cast<std::size_t>(parent[j])].push_back(static_cast<Column>(j));
  std::vector<Column> order;
  std::vector<std::pair<std::size_t, std::size_t>> path{{count, 0}};
  while (!path.empty()) {
    auto& [node, next] = path.back();
    if (next < children[node].size()) {
      const auto child = static_cast<std::size_t>(children[node][next++]);
      path.emplace_back(child, 0);
      continue;
    }
    if (node < count)
      order.push_back(static_cast<Column>(node));
    path.pop_back();
  }
  return order;
}

/// Of each column of the factor the rows below its diagonal, rising.
std::vector<std::vector<Column>> factorPattern(const Matrix& lower, const std::vector<Column>& parent) {
  std::vector<std::vector<Column>> rows(parent.size());
  std::vector<Column> merged;
  for (std::size_t j = 0; j < rows.size(); ++j) { // children come before: they have put their rows here
    std::vector<Column>& own = rows[j];
    for (Matrix::InnerIterator it(lower, static_cast<Column>(j)); it; ++it)
      if (it.row() > static_cast<Column>(j))
        own.push_back(static_cast<Column>(it.row()));
    std::sort(own.begin(), own.end());
    own.erase(std::unique(own.begin(), own.end()), own.end());
    if (parent[j] < 0)
      continue;
    std::vector<Column>& of_parent = rows[static_cast<std::size_t>(parent[j])];
    of_parent.insert(of_parent.end(), own.begin() + 1, own.end()); // the first is the parent
  }
  return rows;
}

} // namespace

/// Where a row stands in the factor.
Eigen::Index SupernodalCholesky::Supernode::rowOf(Column row) const {
  return row < first + count ? row - first : count + (std::lower_bound(below.begin(), below.end(), row) - below.begin());
}

SupernodalCholesky::SupernodalCholesky(const Matrix& matrix) {
  order(matrix);
  findSupernodes();
  ok_ = factorise();
}

void SupernodalCholesky::order(const Matrix& matrix) {
  Permutation from_ordered;
  Eigen::AMDOrdering<Column>()(matrix, from_ordered);
  to_ordered_ = from_ordered.size() > 0 ? Permutation(from_ordered.inverse()) : Permutation(matrix.rows());
  if (from_ordered.size() == 0)
    to_ordered_.setIdentity();
  const std::vector<Column> post = postorder(eliminationTree(lowerOf(matrix, to_ordered_)));
  Permutation to_post(static_cast<Eigen::Index>(post.size()));
  for (std::size_t i = 0; i < post.size(); ++i)
    to_post.indices()[post[i]] = static_cast<Column>(i);
  to_ordered_ = to_post * to_ordered_;
  lower_ = lowerOf(matrix, to_ordered_);
  parent_ = eliminationTree(lower_);
}

void SupernodalCholesky::findSupernodes() {
  std::vector<std::vector<Column>> rows = factorPattern(lower_, parent_);
  const auto count = static_cast<Column>(rows.size());
  const auto below = [&](Column j) { return static_cast<double>(rows[static_cast<std::size_t>(j)].size()); };
  double entries = 0.0;
  for (Column j = 0; j < count; ++j) {
    const bool follows = !nodes_.empty() && parent_[static_cast<std::size_t>(j - 1)] == j;
    const auto width = follows ? static_cast<double>(nodes_.back().count) : 0.0;
    const double all = 0.5 * (width + 1.0) * (width + 2.0) + (width + 1.0) * below(j);
    const double filled = entries + 1.0 + below(j);
    if (follows && all - filled <= (nodes_.back().count < kNarrow ? kZerosOfNarrow : kZeros) * all) {
      ++nodes_.back().count;
      entries = filled;
    } else {
      nodes_.emplace_back();
      nodes_.back().first = j;
      nodes_.back().count = 1;
      entries = 1.0 + below(j);
    }
  }
  for (Supernode& node : nodes_)
    node.below = std::move(rows[static_cast<std::size_t>(node.first + node.count - 1)]);
}

/// The matrix's own entries in the columns of a supernode.
Eigen::MatrixXd SupernodalCholesky::front(const Supernode& node) const {
  const auto size = static_cast<Eigen::Index>(node.below.size()) + node.count;
  Eigen::MatrixXd front = Eigen::MatrixXd::Zero(size, size);
  for (Column c = 0; c < node.count; ++c)
    for (Matrix::InnerIterator it(lower_, node.first + c); it; ++it)
      front(node.rowOf(static_cast<Column>(it.row())), c) = it.value();
  return front;
}

/// Adds what a supernode further down left of its rows.
void SupernodalCholesky::take(const Supernode& child, const Eigen::MatrixXd& left, const Supernode& node, Eigen::MatrixXd& front) {
  std::vector<Eigen::Index> rows;
  for (const Column row : child.below)
    rows.push_back(node.rowOf(row));
  for (std::size_t j = 0; j < rows.size(); ++j)
    for (std::size_t i = j; i < rows.size(); ++i)
      front(rows[i], rows[j]) += left(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
}

bool SupernodalCholesky::factorise() {
  std::vector<std::size_t> node_of(static_cast<std::size_t>(lower_.cols()));
  for (std::size_t n = 0; n < nodes_.size(); ++n)
    for (Column c = 0; c < nodes_[n].count; ++c)
      node_of[static_cast<std::size_t>(nodes_[n].first + c)] = n;
  std::vector<std::vector<std::size_t>> children(nodes_.size());
  std::vector<Eigen::MatrixXd> rest(nodes_.size()); // what a supernode leaves of the rows below it
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    Supernode& node = nodes_[n];
    Eigen::MatrixXd front = this->front(node);
    for (const std::size_t child : children[n]) {
      take(nodes_[child], rest[child], node, front);
      rest[child].resize(0, 0);
    }
    const Eigen::Index width = node.count, height = front.rows() - width;
    Eigen::Ref<Eigen::MatrixXd> own = front.topLeftCorner(width, width);
    const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> llt(own);
    if (llt.info() != Eigen::Success)
      return false;
    auto beneath = front.bottomLeftCorner(height, width);
    own.triangularView<Eigen::Lower>().transpose().solveInPlace<Eigen::OnTheRight>(beneath);
    node.factor = front.leftCols(width);
    if (height == 0)
      continue;
    rest[n] = front.bottomRightCorner(height, height);
    rest[n].selfadjointView<Eigen::Lower>().rankUpdate(node.factor.bottomRows(height), -1.0);
    children[node_of[static_cast<std::size_t>(node.below.front())]].push_back(n);
  }
  return true;
}

Eigen::VectorXd SupernodalCholesky::solve(const Eigen::VectorXd& right) const {
  Eigen::VectorXd x = to_ordered_ * right;
  for (const Supernode& node : nodes_) {
    auto own = x.segment(node.first, node.count);
    const auto own_factor = node.factor.topRows(node.count);
    own_factor.triangularView<Eigen::Lower>().solveInPlace(own);
    const Eigen::VectorXd passed_on = node.factor.bottomRows(node.factor.rows() - node.count) * own;
    for (std::size_t i = 0; i < node.below.size(); ++i)
      x[node.below[i]] -= passed_on[static_cast<Eigen::Index>(i)];
  }
  for (auto node = nodes_.rbegin(); node != nodes_.rend(); ++node) {
    Eigen::VectorXd below(static_cast<Eigen::Index>(node->below.size()));
    for (std::size_t i = 0; i < node->below.size(); ++i)
      below[static_cast<Eigen::Index>(i)] = x[node->below[i]];
    auto own = x.segment(node->first, node->count);
    own -= node->factor.bottomRows(below.size()).transpose() * below;
    node->factor.topRows(node->count).triangularView<Eigen::Lower>().transpose().solveInPlace(own);
  }
  return to_ordered_.inverse() * x;
}

} // namespace graben::detail
