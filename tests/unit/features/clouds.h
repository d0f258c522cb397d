#pragma once

#include "graben/core/types.h"

#include <cmath>
#include <random>

namespace graben::test {

/// Random numbers that are the same with every standard library.
class Random {
public:
  explicit Random(std::uint64_t seed)
      : engine_(seed) {}
  double uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
  }
  double normal(double sigma) {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform(0.0, 1.0)));
    return sigma * radius * std::cos(uniform(0.0, 2.0 * 3.14159265358979323846));
  }

private:
  std::mt19937_64 engine_;
};

/// Random points on a wavy horizon over the square [0, size]^2.
inline Points wavySheet(std::size_t count, double size, double noise, std::uint64_t seed = 1) {
  Random random(seed);
  Points points;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = random.uniform(0.0, size), y = random.uniform(0.0, size);
    points.emplace_back(x, y,
                        0.01 * size * std::sin(6.0 * x / size) * std::cos(5.0 * y / size) +
                            random.normal(noise));
  }
  return points;
}

} // namespace graben::test
