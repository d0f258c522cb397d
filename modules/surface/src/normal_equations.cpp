#include "normal_equations.h"

#include <cmath>
#include <cstring>

namespace graben::detail {

namespace {

/// Two doubles side by side; compilers make one instruction of each operation.
using Pair = double __attribute__((vector_size(16)));

Pair load(const double* p) {
  Pair pair;
  std::memcpy(&pair, p, sizeof pair);
  return pair;
}

constexpr std::size_t slot(int a, int b) { return static_cast<std::size_t>((a + b) * (a + b + 1) / 2 + b); }

constexpr std::array<std::array<int, 2>, kMaxTerms> kExponents = {
    {{0, 0}, {1, 0}, {0, 1}, {2, 0}, {1, 1}, {0, 2}, {3, 0}, {2, 1}, {1, 2}, {0, 3}}};

} // namespace

std::array<double, kMaxTerms> monomials(double u, double v) {
  return {1.0, u, v, u * u, u * v, v * v, u * u * u, u * u * v, u * v * v, v * v * v};
}

template <int Degree>
void NormalEquations::add(const double* u, const double* v, const double* height, const double* weight, std::size_t count) {
  constexpr int top = 2 * Degree;
  std::array<Pair, termsOf(top)> moments{};
  std::array<Pair, termsOf(Degree)> heights{};
  for (std::size_t i = 0; i < count; i += 2) {
    const Pair pu = load(u + i), pv = load(v + i), ph = load(height + i);
    Pair row = load(weight + i);
#pragma GCC unroll 8
    for (int b = 0; b <= top; ++b) {
      Pair product = row;
#pragma GCC unroll 8
      for (int a = 0; a + b <= top; ++a) {
        moments[slot(a, b)] += product;
        if (a + b <= Degree)
          heights[slot(a, b)] += product * ph;
        product *= pu;
      }
      row *= pv;
    }
  }
  for (int i = 0; i < terms_; ++i) {
    const auto& [ai, bi] = kExponents[static_cast<std::size_t>(i)];
    for (int j = 0; j <= i; ++j) {
      const auto& [aj, bj] = kExponents[static_cast<std::size_t>(j)];
      const Pair& sum = moments[slot(ai + aj, bi + bj)];
      at(i, j) += sum[0] + sum[1];
    }
    right_[static_cast<std::size_t>(i)] += heights[static_cast<std::size_t>(i)][0] + heights[static_cast<std::size_t>(i)][1];
  }
}

void NormalEquations::addHeights(const double* u, const double* v, const double* height, const double* weight, std::size_t count) {
  if (degree_ == 1)
    add<1>(u, v, height, weight, count);
  else if (degree_ == 2)
    add<2>(u, v, height, weight, count);
  else
    add<3>(u, v, height, weight, count);
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
