#include "support_kernels.h"

#include "graben/core/clones.h"

#include <cstring>
#include <limits>

namespace graben::detail {

GRABEN_AVX2_CLONE std::size_t keepWithin(double squared_distance, const PickArrays& picks, std::size_t count) {
  for (std::size_t i = count; i < roundUpToLanes(count); ++i)
    picks.squared[i] = std::numeric_limits<double>::infinity();
  std::size_t found = 0;
  for (std::size_t i = 0; i < count; i += kLanes) {
    Lanes u, v, height, squared;
    load(picks.u + i, u);
    load(picks.v + i, v);
    load(picks.height + i, height);
    load(picks.squared + i, squared);
    append(Packing(squared <= squared_distance), u, v, height, squared, picks.index + i, picks, found);
  }
  return found;
}

GRABEN_AVX2_CLONE Range rangeWithZero(double* numbers, std::size_t count) {
  for (std::size_t i = count; i < roundUpToLanes(count); ++i)
    numbers[i] = 0.0;
  Lanes low = {}, high = {};
  for (std::size_t i = 0; i < count; i += kLanes) {
    Lanes number;
    load(numbers + i, number);
    low = number < low ? number : low;
    high = number > high ? number : high;
  }
  Range range;
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    range.low = low[lane] < range.low ? low[lane] : range.low;
    range.high = high[lane] > range.high ? high[lane] : range.high;
  }
  return range;
}

GRABEN_AVX2_CLONE void scaleAndWeigh(const PickArrays& picks, std::size_t count, double inverse_radius, const ScaledArrays& out) {
  const double inverse_squared = inverse_radius * inverse_radius;
  for (std::size_t i = 0; i < count; i += kLanes) {
    Lanes u, v, weight;
    std::memcpy(&u, picks.u + i, sizeof u);
    std::memcpy(&v, picks.v + i, sizeof v);
    std::memcpy(&weight, picks.squared + i, sizeof weight);
    u *= inverse_radius;
    v *= inverse_radius;
    weight = 1.0 - weight * inverse_squared;
    weight = weight > 0.0 ? weight * weight : Lanes{};
    std::memcpy(out.u + i, &u, sizeof u);
    std::memcpy(out.v + i, &v, sizeof v);
    std::memcpy(out.weight + i, &weight, sizeof weight);
  }
  for (std::size_t i = count; i < roundUpToLanes(count); ++i)
    out.u[i] = out.v[i] = out.weight[i] = 0.0;
}

GRABEN_AVX2_CLONE WeightSum sumWeights(const double* weight, std::size_t count) {
  Lanes total = {}, used = {};
  for (std::size_t i = 0; i < count; i += kLanes) {
    Lanes w;
    std::memcpy(&w, weight + i, sizeof w);
    total += w;
    used += w > 0.0 ? Lanes{} + 1.0 : Lanes{};
  }
  return {(total[0] + total[1]) + (total[2] + total[3]), static_cast<std::size_t>((used[0] + used[1]) + (used[2] + used[3]))};
}

GRABEN_AVX2_CLONE Misfit misfit(const ScaledArrays& places, const double* height, std::size_t count, const double* coefficients, double* residual) {
  Lanes largest = {}, sum = {};
  for (std::size_t i = 0; i < count; i += kLanes) {
    Lanes u, v, off, weight, fitted;
    std::memcpy(&u, places.u + i, sizeof u);
    std::memcpy(&v, places.v + i, sizeof v);
    std::memcpy(&off, height + i, sizeof off);
    std::memcpy(&weight, places.weight + i, sizeof weight);
    heightOf(coefficients, u, v, fitted);
    off -= fitted;
    off = off < 0.0 ? -off : off;
    std::memcpy(residual + i, &off, sizeof off);
    const Lanes counted = weight > 0.0 ? off : Lanes{};
    largest = counted > largest ? counted : largest;
    sum += counted;
  }
  Misfit result{0.0, 0.0};
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    result.largest = result.largest < largest[lane] ? largest[lane] : result.largest;
    result.sum += sum[lane];
  }
  return result;
}

} // namespace graben::detail
