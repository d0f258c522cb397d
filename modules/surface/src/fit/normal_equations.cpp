#include "normal_equations.h"

#include "local/support_kernels.h"

#include "graben/core/clones.h"

#include <cmath>
#include <cstring>

namespace graben::detail {

namespace {

constexpr std::size_t slot(int a, int b) { return static_cast<std::size_t>((a + b) * (a + b + 1) / 2 + b); }

constexpr std::array<std::array<int, 2>, kMaxTerms> kExponents = {
    {{0, 0}, {1, 0}, {0, 1}, {2, 0}, {1, 1}, {0, 2}, {3, 0}, {2, 1}, {1, 2}, {0, 3}}};

constexpr std::size_t kMaxMoments = static_cast<std::size_t>(termsOf(2 * kMaxDegree));

struct WeightedHeights {
  const double *u, *v, *height, *weight;
  std::size_t count;
};

template <int Degree>
[[gnu::always_inline]] inline void sum(const WeightedHeights& in, double* moment_sums, double* height_sums) {
  constexpr int top = 2 * Degree;
  Lanes moments[termsOf(top)] = {};
  Lanes heights[termsOf(Degree)] = {};
  for (std::size_t i = 0; i < in.count; i += kLanes) {
    Lanes u, v, height, row;
    std::memcpy(&u, in.u + i, sizeof u);
    std::memcpy(&v, in.v + i, sizeof v);
    std::memcpy(&height, in.height + i, sizeof height);
    std::memcpy(&row, in.weight + i, sizeof row);
    height = row > 0.0 ? height : Lanes{};
#pragma GCC unroll 8
    for (int b = 0; b <= top; ++b) {
      Lanes product = row;
#pragma GCC unroll 8
      for (int a = 0; a + b <= top; ++a) {
        moments[slot(a, b)] += product;
        if (a + b <= Degree)
          heights[slot(a, b)] += product * height;
        product *= u;
      }
      row *= v;
    }
  }
  for (const Lanes& m : moments)
    *moment_sums++ = (m[0] + m[1]) + (m[2] + m[3]);
  for (const Lanes& h : heights)
    *height_sums++ = (h[0] + h[1]) + (h[2] + h[3]);
}

GRABEN_AVX2_CLONE void sumPlane(const WeightedHeights& in, double* moments, double* heights) { sum<1>(in, moments, heights); }
GRABEN_AVX2_CLONE void sumQuadric(const WeightedHeights& in, double* moments, double* heights) { sum<2>(in, moments, heights); }
GRABEN_AVX2_CLONE void sumCubic(const WeightedHeights& in, double* moments, double* heights) { sum<3>(in, moments, heights); }

} // namespace

std::array<double, kMaxTerms> monomials(double u, double v) {
  return {1.0, u, v, u * u, u * v, v * v, u * u * u, u * u * v, u * v * v, v * v * v};
}

void NormalEquations::addHeights(const double* u, const double* v, const double* height, const double* weight, std::size_t count) {
  std::array<double, kMaxMoments> moments{};
  std::array<double, kMaxTerms> heights{};
  const auto sum = degree_ == 1 ? sumPlane : degree_ == 2 ? sumQuadric : sumCubic;
  sum({u, v, height, weight, count}, moments.data(), heights.data());
  addMoments(moments.data(), heights.data());
}

void NormalEquations::addMoments(const double* moments, const double* heights) {
  for (int i = 0; i < terms_; ++i) {
    const auto& [ai, bi] = kExponents[static_cast<std::size_t>(i)];
    for (int j = 0; j <= i; ++j) {
      const auto& [aj, bj] = kExponents[static_cast<std::size_t>(j)];
      at(i, j) += moments[slot(ai + aj, bi + bj)];
    }
    right_[static_cast<std::size_t>(i)] += heights[static_cast<std::size_t>(i)];
  }
}

void NormalEquations::addEquation(const Row& row, double right, double weight) {
  for (int i = 0; i < terms_; ++i) {
    for (int j = 0; j <= i; ++j)
      at(i, j) += weight * row[static_cast<std::size_t>(i)] * row[static_cast<std::size_t>(j)];
    right_[static_cast<std::size_t>(i)] += weight * right * row[static_cast<std::size_t>(i)];
  }
}

void NormalEquations::addSlopes(double u, double v, double slope_u, double slope_v, double weight) {
  addEquation({0.0, 1.0, 0.0, 2.0 * u, v, 0.0, 3.0 * u * u, 2.0 * u * v, v * v, 0.0}, slope_u, weight);
  addEquation({0.0, 0.0, 1.0, 0.0, u, 2.0 * v, 0.0, u * u, 2.0 * u * v, 3.0 * v * v}, slope_v, weight);
}

void NormalEquations::addStiffness(int degree, double weight) {
  for (int i = degree > 0 ? termsOf(degree - 1) : 0; i < termsOf(degree) && i < terms_; ++i)
    at(i, i) += weight;
}

bool NormalEquations::solve(std::array<double, kMaxTerms>& coefficients) {
  const double least = 1e-12 * at(0, 0);
  for (int j = 0; j < terms_; ++j) {
    for (int k = 0; k < j; ++k)
      at(j, j) -= at(j, k) * at(j, k);
    if (!(at(j, j) > least))
      return false;
    at(j, j) = std::sqrt(at(j, j));
    for (int i = j + 1; i < terms_; ++i) {
      for (int k = 0; k < j; ++k)
        at(i, j) -= at(i, k) * at(j, k);
      at(i, j) /= at(j, j);
    }
  }
  coefficients.fill(0.0);
  for (int i = 0; i < terms_; ++i) {
    double sum = right_[static_cast<std::size_t>(i)];
    for (int k = 0; k < i; ++k)
      sum -= at(i, k) * coefficients[static_cast<std::size_t>(k)];
    coefficients[static_cast<std::size_t>(i)] = sum / at(i, i);
  }
  for (int i = terms_ - 1; i >= 0; --i) {
    for (int k = i + 1; k < terms_; ++k)
      coefficients[static_cast<std::size_t>(i)] -= at(k, i) * coefficients[static_cast<std::size_t>(k)];
    coefficients[static_cast<std::size_t>(i)] /= at(i, i);
  }
  return true;
}

double NormalEquations::leverage(double u, double v, double weight) const {
  const Row row = monomials(u, v);
  Row half{};
  double sum = 0.0;
  for (int i = 0; i < terms_; ++i) {
    double value = row[static_cast<std::size_t>(i)];
    for (int k = 0; k < i; ++k)
      value -= at(i, k) * half[static_cast<std::size_t>(k)];
    half[static_cast<std::size_t>(i)] = value / at(i, i);
    sum += half[static_cast<std::size_t>(i)] * half[static_cast<std::size_t>(i)];
  }
  return weight * sum;
}

} // namespace graben::detail
