#pragma once

#include "lanes.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace graben::detail {

/// Height of a polynomial given as the factors of its monomials in the order of termsOf().
template <typename Coefficient, typename Number>
[[gnu::always_inline]] inline void heightOf(const Coefficient* c, const Number& u, const Number& v, Number& height) {
  height = c[0] + u * (c[1] + u * (c[3] + u * c[6])) + v * (c[2] + v * (c[5] + v * c[9])) + u * v * (c[4] + u * c[7] + v * c[8]);
}

/// The picks of a support: places and heights in its frame, squared distances within its plane.
struct PickArrays {
  double *u, *v, *height, *squared;
  std::int32_t* index;
};

/// Appends those of kLanes picks that are chosen to the \a count there are; the arrays have room for kLanes more.
[[gnu::always_inline]] inline void append(const Packing& chosen, const Lanes& u, const Lanes& v, const Lanes& height, const Lanes& squared,
                                          const std::int32_t* index, const PickArrays& out, std::size_t& count) {
  chosen.store(u, out.u + count);
  chosen.store(v, out.v + count);
  chosen.store(height, out.height + count);
  chosen.store(squared, out.squared + count);
  chosen.store(index, out.index + count);
  count += chosen.count();
}

/// Keeps the picks for which keep(i) holds, in their order.
template <typename Keep>
void keepIf(const PickArrays& picks, std::size_t& count, const Keep& keep) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const bool stays = keep(i);
    picks.u[kept] = picks.u[i];
    picks.v[kept] = picks.v[i];
    picks.height[kept] = picks.height[i];
    picks.squared[kept] = picks.squared[i];
    picks.index[kept] = picks.index[i];
    kept += stays ? 1 : 0;
  }
  count = kept;
}

/// Keeps the picks within a distance in the plane, in their order; the arrays have room for a multiple of kLanes. \return how many there are
std::size_t keepWithin(double squared_distance, const PickArrays& picks, std::size_t count);

struct Range {
  double low = 0.0;
  double high = 0.0;
};

/// From the least to the largest of some numbers and 0. The array has room for a multiple of kLanes and is filled up.
Range rangeWithZero(double* numbers, std::size_t count);

/// Places in units of the radius of a support, and weights.
struct ScaledArrays {
  double *u, *v, *weight;
};

/// Weights fall smoothly from 1 to 0 at the radius 1 / inverse_radius. Behind the last pick places and weights are 0 up to a multiple of kLanes.
void scaleAndWeigh(const PickArrays& picks, std::size_t count, double inverse_radius, const ScaledArrays& out);

struct WeightSum {
  double total;
  std::size_t used; ///< weights greater than 0
};
WeightSum sumWeights(const double* weight, std::size_t count);

/// How far picks with a weight lie off a polynomial.
struct Misfit {
  double largest;
  double sum;
};

/// \param[out] residual absolute, for all picks
Misfit misfit(const ScaledArrays& places, const double* height, std::size_t count, const double* coefficients, double* residual);

} // namespace graben::detail
