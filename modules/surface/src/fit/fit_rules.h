#pragma once

#include "normal_equations.h"

namespace graben::detail {

constexpr double kRidge = 1e-6;  // weight that keeps all coefficients but the height down, as a share of all picks'
constexpr double kSuspect = 5.5; // largest residual over the mean one that calls for a closer look; Gaussian noise stays below
constexpr int kSpareEquations = 3; // more than coefficients

/// The degree up to the one wanted that so many equations allow; 0 if none.
inline int allowedDegree(int wanted, std::size_t equations) {
  while (wanted > 1 && static_cast<int>(equations) < termsOf(wanted) + kSpareEquations)
    --wanted;
  return equations < 4 ? 0 : wanted;
}

/// Whether there are so many picks that one that lies off the polynomial can be told from the others, and one seems to.
inline bool seemsToHaveBlunders(int degree, std::size_t picks, double largest_residual, double sum_of_residuals) {
  return static_cast<int>(picks) > 2 * termsOf(degree) + kSpareEquations && !(largest_residual < kSuspect * sum_of_residuals / static_cast<double>(picks));
}

} // namespace graben::detail
