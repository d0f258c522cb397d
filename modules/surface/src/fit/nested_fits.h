#pragma once

#include "normal_equations.h"

#include <cstddef>
#include <vector>

namespace graben::detail {

/// Heights over places of a plane: u[i], v[i] -> height[i]. The arrays hold kPadding finite numbers more than are asked for.
struct HeightSamples {
  const double* u;
  const double* v;
  const double* height;

  static constexpr std::size_t kPadding = 3;
};

/// The sums from which least-squares polynomials over any disc about the origin follow, so that many discs, one within the other, and many degrees cost
/// little more than one: each sample is added once.
///
/// The weight within a disc of radius R is (1 - r^2 / R^2)^2, which is 1, r^2 and r^4 in a certain mixture: all three are summed.
class NestedFits {
public:
  /// Adds samples number begin to end - 1.
  void add(const HeightSamples& samples, std::size_t begin, std::size_t end);

  /// The equations of the polynomial, in units of the radius, through the samples added, which must be all those within the radius and no others.
  /// \param[in] degree 1 to kMaxDegree
  NormalEquations equations(int degree, double radius) const;

  /// The sum of the weights within that radius.
  double totalWeight(double radius) const;

private:
  static constexpr std::size_t kMoments = static_cast<std::size_t>(termsOf(2 * kMaxDegree));
  static constexpr std::size_t kSums = 3 * (kMoments + kMaxTerms);

  std::array<double, 3> mixture(double radius) const { return {1.0, -2.0 / (radius * radius), 1.0 / (radius * radius * radius * radius)}; }

  std::array<double, kSums> sums_{}; ///< of 1, r^2, r^4 times the monomials; then of the same times the heights
};

/// How far samples lie off a polynomial.
struct Residuals {
  double largest = 0.0;
  double sum = 0.0;
};

/// \param[in] count        the first so many samples are looked at
/// \param[in] coefficients of the polynomial in units of the radius
Residuals residuals(const HeightSamples& samples, std::size_t count, const std::array<double, kMaxTerms>& coefficients, double radius);

} // namespace graben::detail
