#include "nested_fits.h"

#include "local/support_kernels.h"

#include "graben/core/clones.h"

#include <cstring>

namespace graben::detail {

namespace {

constexpr int kTop = 2 * kMaxDegree;

/// 1 in the first so many lanes, 0 in the others.
void loadOnes(std::size_t count, Lanes& lanes) {
  constexpr double ones[2 * kLanes] = {1.0, 1.0, 1.0, 1.0};
  load(ones + (count < kLanes ? kLanes - count : 0), lanes);
}

/// \param[in,out] sums as NestedFits holds them
GRABEN_AVX2_CLONE void addSums(const HeightSamples& samples, std::size_t begin, std::size_t end, double* sums) {
  constexpr int moments = termsOf(kTop);
  Lanes totals[3 * (moments + kMaxTerms)] = {};
  for (std::size_t i = begin; i < end; i += kLanes) {
    Lanes u, v, height, row;
    load(samples.u + i, u);
    load(samples.v + i, v);
    load(samples.height + i, height);
    const Lanes squared = u * u + v * v;
    loadOnes(end - i, row);
#pragma GCC unroll 8
    for (int b = 0; b <= kTop; ++b) {
      Lanes product = row;
#pragma GCC unroll 8
      for (int a = 0; a + b <= kTop; ++a) {
        const int slot = (a + b) * (a + b + 1) / 2 + b;
        const Lanes second = product * squared, fourth = second * squared;
        totals[slot] += product;
        totals[moments + slot] += second;
        totals[2 * moments + slot] += fourth;
        if (a + b <= kMaxDegree) {
          totals[3 * moments + slot] += product * height;
          totals[3 * moments + kMaxTerms + slot] += second * height;
          totals[3 * moments + 2 * kMaxTerms + slot] += fourth * height;
        }
        product *= u;
      }
      row *= v;
    }
  }
  for (int i = 0; i < 3 * (moments + kMaxTerms); ++i)
    sums[i] += (totals[i][0] + totals[i][1]) + (totals[i][2] + totals[i][3]);
}

/// \param[in] scale units of the polynomial in one of the samples
GRABEN_AVX2_CLONE void addResiduals(const HeightSamples& samples, std::size_t count, const double* c, double scale, Residuals& result) {
  Lanes largest = {}, sum = {};
  for (std::size_t i = 0; i < count; i += kLanes) {
    Lanes u, v, off, fitted, there;
    load(samples.u + i, u);
    load(samples.v + i, v);
    load(samples.height + i, off);
    u *= scale;
    v *= scale;
    heightOf(c, u, v, fitted);
    off -= fitted;
    loadOnes(count - i, there);
    off *= there;
    off = off < 0.0 ? -off : off;
    largest = off > largest ? off : largest;
    sum += off;
  }
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    result.largest = result.largest < largest[lane] ? largest[lane] : result.largest;
    result.sum += sum[lane];
  }
}

} // namespace

void NestedFits::add(const HeightSamples& samples, std::size_t begin, std::size_t end) { addSums(samples, begin, end, sums_.data()); }

double NestedFits::totalWeight(double radius) const {
  const std::array<double, 3> mix = mixture(radius);
  return mix[0] * sums_[0] + mix[1] * sums_[kMoments] + mix[2] * sums_[2 * kMoments];
}

NormalEquations NestedFits::equations(int degree, double radius) const {
  const std::array<double, 3> mix = mixture(radius);
  std::array<double, kMoments> moments;
  std::array<double, kMaxTerms> heights;
  const double* height_sums = sums_.data() + 3 * kMoments;
  double scale = 1.0;
  for (int order = 0; order <= 2 * degree; ++order, scale /= radius)
    for (auto i = static_cast<std::size_t>(termsOf(order - 1)); i < static_cast<std::size_t>(termsOf(order)); ++i) {
      moments[i] = scale * (mix[0] * sums_[i] + mix[1] * sums_[kMoments + i] + mix[2] * sums_[2 * kMoments + i]);
      if (order <= degree)
        heights[i] = scale * (mix[0] * height_sums[i] + mix[1] * height_sums[kMaxTerms + i] + mix[2] * height_sums[2 * kMaxTerms + i]);
    }
  NormalEquations equations(degree);
  equations.addMoments(moments.data(), heights.data());
  return equations;
}

Residuals residuals(const HeightSamples& samples, std::size_t count, const std::array<double, kMaxTerms>& coefficients, double radius) {
  Residuals result;
  addResiduals(samples, count, coefficients.data(), 1.0 / radius, result);
  return result;
}

} // namespace graben::detail
