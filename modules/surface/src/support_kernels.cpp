#include "support_kernels.h"

#include "graben/core/clones.h"

#include <cstring>

namespace graben::detail {

namespace {

/// Doubles side by side; compilers make one or two instructions of each operation.
using Lanes = double __attribute__((vector_size(8 * kLanes)));

} // namespace

std::size_t collectRun(const DiscQuery& query, const PickRun& run, const double* normals, const PickArrays& out, std::size_t count) {
  const double x = query.centre[0], y = query.centre[1], z = query.centre[2];
  for (std::size_t i = 0; i < run.count; ++i) {
    const double dx = run.points[3 * i] - x, dy = run.points[3 * i + 1] - y, dz = run.points[3 * i + 2] - z;
    const std::int32_t pick = run.indices != nullptr ? run.indices[i] : run.first + static_cast<std::int32_t>(i);
    const double* n = normals + 3 * static_cast<std::size_t>(pick);
    const double u = dx * query.u[0] + dy * query.u[1] + dz * query.u[2];
    const double v = dx * query.v[0] + dy * query.v[1] + dz * query.v[2];
    const double height = dx * query.normal[0] + dy * query.normal[1] + dz * query.normal[2];
    const double cosine = n[0] * query.normal[0] + n[1] * query.normal[1] + n[2] * query.normal[2];
    const double squared = u * u + v * v;
    out.u[count] = u;
    out.v[count] = v;
    out.height[count] = height;
    out.squared[count] = squared;
    out.index[count] = pick;
    const std::size_t within = squared + height * height <= query.squared_radius ? 1 : 0, faces = cosine > query.least_cosine ? 1 : 0;
    count += within & faces; // no branch: a pick not taken is written over by the next
  }
  return count;
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
