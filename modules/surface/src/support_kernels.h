#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace graben::detail {

/// Picks are worked on so many at a time: arrays have room for a multiple of them, and what stands behind the last pick has weight 0.
constexpr std::size_t kLanes = 4;

constexpr std::size_t roundUpToLanes(std::size_t count) { return (count + kLanes - 1) / kLanes * kLanes; }

/// Height of a polynomial given as the factors of its monomials in the order of termsOf().
template <typename Number>
[[gnu::always_inline]] inline void heightOf(const double* c, const Number& u, const Number& v, Number& height) {
  height = c[0] + u * (c[1] + u * (c[3] + u * c[6])) + v * (c[2] + v * (c[5] + v * c[9])) + u * v * (c[4] + u * c[7] + v * c[8]);
}

/// Which picks are collected, and the frame they are then given in: u, v and normal are unit axes.
struct DiscQuery {
  std::array<double, 3> centre, u, v, normal;
  double squared_radius;
  double least_cosine; ///< between a pick's normal and the frame's
};

/// Picks that follow each other in memory.
struct PickRun {
  const double* points; ///< x y z x y z ...
  std::size_t count;
  const std::int32_t* indices; ///< of the picks; null: first, first + 1, ...
  std::int32_t first;
};

/// The picks of a support: places and heights in its frame, squared distances within its plane.
struct PickArrays {
  double *u, *v, *height, *squared;
  std::int32_t* index;
};

/// Appends the picks of a run that lie within the radius and face the right way. \param[in] normals of all picks: x y z x y z ...
/// \param[in] count picks there are already; the arrays have room for all of the run behind them
/// \return how many there are now
std::size_t collectRun(const DiscQuery& query, const PickRun& run, const double* normals, const PickArrays& out, std::size_t count);

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
