#include "kriging/supernodal_cholesky.h"

#include "shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>
#include <vector>

namespace graben {
namespace {

using detail::SupernodalCholesky;
using Matrix = Eigen::SparseMatrix<double>;

/// Of rows that each couple some columns near each other and some far, and a share of one alone.
Matrix random(Eigen::Index size, unsigned seed) {
  test::Random random(seed);
  std::vector<Eigen::Triplet<double>> entries;
  const auto some = [&] { return std::clamp<Eigen::Index>(static_cast<Eigen::Index>(std::abs(random.normal(0.5)) * static_cast<double>(size)), 0, size - 1); };
  Eigen::Index rows = 0;
  for (Eigen::Index i = 0; i < size; ++i, ++rows) {
    entries.emplace_back(rows, i, 1.0 + std::abs(random.normal(1.0)));
    for (const Eigen::Index other : {(i + 1) % size, (i + 7) % size, some()})
      entries.emplace_back(rows, other, random.normal(0.5));
  }
  Matrix design(rows, size);
  design.setFromTriplets(entries.begin(), entries.end());
  return Matrix(design.transpose()) * design;
}

TEST(SupernodalCholesky, SolvesAsADenseFactorisationDoes) {
  for (const Eigen::Index size : {1, 2, 9, 60, 300}) {
    const Matrix matrix = random(size, static_cast<unsigned>(size));
    const Eigen::VectorXd right = Eigen::VectorXd::LinSpaced(size, -1.0, 2.0);
    const SupernodalCholesky factor(matrix);
    ASSERT_TRUE(factor.ok()) << size;
    const Eigen::VectorXd expected = Eigen::MatrixXd(matrix).ldlt().solve(right);
    EXPECT_LT((factor.solve(right) - expected).norm(), 1e-7 * expected.norm()) << size;
  }
}

TEST(SupernodalCholesky, SolvesWhereColumnsHaveNothingToDoWithEachOther) {
  Matrix matrix(5, 5);
  for (Eigen::Index i = 0; i < 5; ++i)
    matrix.insert(i, i) = static_cast<double>(i + 1);
  const SupernodalCholesky factor(matrix);
  ASSERT_TRUE(factor.ok());
  EXPECT_LT((factor.solve(Eigen::VectorXd::LinSpaced(5, 1.0, 5.0)) - Eigen::VectorXd::Ones(5)).norm(), 1e-14);
}

TEST(SupernodalCholesky, AMatrixThatIsNotPositiveDefiniteIsSaidToBe) {
  Matrix matrix(2, 2);
  matrix.insert(0, 0) = 1.0;
  matrix.insert(1, 1) = 1.0;
  matrix.insert(0, 1) = matrix.insert(1, 0) = 2.0;
  EXPECT_FALSE(SupernodalCholesky(matrix).ok());
}

} // namespace
} // namespace graben
