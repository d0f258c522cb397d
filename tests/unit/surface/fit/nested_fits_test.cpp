#include "fit/nested_fits.h"

#include "shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace graben::detail {
namespace {

/// Samples in the order of their distance from the origin.
struct Samples {
  explicit Samples(std::size_t count) {
    test::Random random(5);
    struct Sample {
      double u, v, height;
    };
    std::vector<Sample> samples;
    for (std::size_t i = 0; i < count; ++i)
      samples.push_back({random.uniform(-30.0, 30.0), random.uniform(-30.0, 30.0), random.uniform(-1.0, 1.0)});
    std::sort(samples.begin(), samples.end(), [](const Sample& a, const Sample& b) { return std::hypot(a.u, a.v) < std::hypot(b.u, b.v); });
    for (const Sample& s : samples) {
      u.push_back(s.u);
      v.push_back(s.v);
      height.push_back(s.height);
    }
    for (std::vector<double>* values : {&u, &v, &height})
      values->resize(count + HeightSamples::kPadding, 0.0);
  }
  HeightSamples view() const { return {u.data(), v.data(), height.data()}; }
  std::size_t within(double radius) const {
    std::size_t count = 0;
    while (count + HeightSamples::kPadding < u.size() && std::hypot(u[count], v[count]) < radius)
      ++count;
    return count;
  }

  std::vector<double> u, v, height;
};

double valueOf(const std::array<double, kMaxTerms>& c, double u, double v) {
  const std::array<double, kMaxTerms> m = monomials(u, v);
  double sum = 0.0;
  for (std::size_t i = 0; i < m.size(); ++i)
    sum += c[i] * m[i];
  return sum;
}

TEST(NestedFits, AreThoseOfEachDiscAlone) {
  const Samples samples(301);
  NestedFits nested;
  std::size_t added = 0;
  for (const double radius : {12.0, 15.0, 15.5, 30.0}) {
    const std::size_t count = samples.within(radius);
    nested.add(samples.view(), added, count);
    added = count;
    for (const int degree : {1, 2, 3}) {
      std::vector<double> u, v, height, weight;
      for (std::size_t i = 0; i < count; ++i) {
        u.push_back(samples.u[i] / radius);
        v.push_back(samples.v[i] / radius);
        height.push_back(samples.height[i]);
        weight.push_back(std::pow(1.0 - u[i] * u[i] - v[i] * v[i], 2));
      }
      double total = 0.0;
      for (const double w : weight)
        total += w;
      for (std::vector<double>* values : {&u, &v, &height, &weight})
        values->resize((count + 3) / 4 * 4, 0.0);
      NormalEquations alone(degree);
      alone.addHeights(u.data(), v.data(), height.data(), weight.data(), u.size());
      NormalEquations equations = nested.equations(degree, radius);
      std::array<double, kMaxTerms> expected, found;
      ASSERT_TRUE(alone.solve(expected));
      ASSERT_TRUE(equations.solve(found));
      EXPECT_NEAR(nested.totalWeight(radius), total, 1e-9);
      for (std::size_t i = 0; i < found.size(); ++i)
        EXPECT_NEAR(found[i], expected[i], 1e-7 * (1.0 + std::abs(expected[i]))) << "radius " << radius << " degree " << degree << " term " << i;
      EXPECT_NEAR(equations.leverage(0.1, 0.2, 0.9), alone.leverage(0.1, 0.2, 0.9), 1e-8);
    }
  }
}

TEST(NestedFits, ResidualsAreThoseOfTheFirstSamples) {
  const Samples samples(50);
  const std::array<double, kMaxTerms> polynomial = {0.1, 0.2, -0.3, 0.4, 0.5, -0.6, 0.7, -0.8, 0.9, 1.0};
  const double radius = 25.0;
  double largest = 0.0, sum = 0.0;
  for (std::size_t count = 1; count <= 50; ++count) {
    const double off = std::abs(samples.height[count - 1] - valueOf(polynomial, samples.u[count - 1] / radius, samples.v[count - 1] / radius));
    largest = std::max(largest, off);
    sum += off;
    const Residuals found = residuals(samples.view(), count, polynomial, radius);
    EXPECT_NEAR(found.largest, largest, 1e-12 * largest);
    EXPECT_NEAR(found.sum, sum, 1e-12 * sum);
  }
}

} // namespace
} // namespace graben::detail
