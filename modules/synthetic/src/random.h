#pragma once

#include <cmath>
#include <cstdint>

namespace graben::synthetic {

/// Counter-based random numbers: the stream of (seed, index) is the same whoever computes it
/// (splitmix64).
class RandomStream {
public:
  RandomStream(std::uint64_t seed, std::uint64_t index)
      : state_(mix(mix(seed) ^ (index * kStep))) {}

  /// Uniform in [0, 1).
  double uniform() { return static_cast<double>(next() >> 11) * 0x1.0p-53; }

  double uniform(double low, double high) { return low + (high - low) * uniform(); }

  /// Standard normal (Box and Muller).
  double gaussian() {
    const double u = 1.0 - uniform();
    return std::sqrt(-2.0 * std::log(u)) * std::cos(6.283185307179586 * uniform());
  }

private:
  static constexpr std::uint64_t kStep = 0x9e3779b97f4a7c15u;

  static std::uint64_t mix(std::uint64_t z) {
    z += kStep;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  std::uint64_t next() {
    const std::uint64_t value = mix(state_);
    state_ += kStep;
    return value;
  }

  std::uint64_t state_;
};

} // namespace graben::synthetic
