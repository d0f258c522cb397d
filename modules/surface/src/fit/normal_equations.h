#pragma once

#include <array>
#include <cstddef>

namespace graben::detail {

constexpr int kMaxDegree = 3;
constexpr int kMaxTerms = 10;

/// Number of monomials u^a v^b with a + b up to the degree; their order is 1, u, v, u^2, u v, v^2, u^3, ...
constexpr int termsOf(int degree) { return (degree + 1) * (degree + 2) / 2; }

/// Values of all monomials up to kMaxDegree at a place.
std::array<double, kMaxTerms> monomials(double u, double v);

/// Weighted least squares for a height as a polynomial of two variables: the matrix of products of monomials, the right side, its solution.
///
/// Coordinates should be scaled so that they are about 1 at the support's rim.
class NormalEquations {
public:
  /// \param[in] degree 1 to kMaxDegree
  explicit NormalEquations(int degree) : degree_(degree), terms_(termsOf(degree)) {}

  /// Adds equations polynomial(u, v) = height. The arrays must have room for a multiple of kLanes, places and weights of 0 behind the last.
  void addHeights(const double* u, const double* v, const double* height, const double* weight, std::size_t count);

  /// Adds equations by their sums. \param[in] moments weighted sums of all monomials up to twice the degree, in their order
  /// \param[in] heights weighted sums of the height times each monomial up to the degree
  void addMoments(const double* moments, const double* heights);

  /// Adds the equations d/du polynomial(u, v) = slope_u and d/dv polynomial(u, v) = slope_v.
  void addSlopes(double u, double v, double slope_u, double slope_v, double weight);

  /// Adds the equations coefficient = 0 for all monomials of one degree.
  void addStiffness(int degree, double weight);

  /// \return false if the equations do not determine the coefficients
  bool solve(std::array<double, kMaxTerms>& coefficients);

  /// After solve(): how much the polynomial at a place changes if the height given there, with this weight, is raised by one.
  double leverage(double u, double v, double weight) const;

private:
  using Row = std::array<double, kMaxTerms>;

  void addEquation(const Row& row, double right, double weight);
  double& at(int i, int j) { return matrix_[static_cast<std::size_t>(i * kMaxTerms + j)]; }
  double at(int i, int j) const { return matrix_[static_cast<std::size_t>(i * kMaxTerms + j)]; }

  int degree_;
  int terms_;
  std::array<double, std::size_t(kMaxTerms) * kMaxTerms> matrix_{}; ///< lower triangle; after solve() its Cholesky factor
  Row right_{};
};

} // namespace graben::detail
