#include "likeliest_correlation.h"

#include <array>
#include <cmath>
#include <limits>
#include <map>

namespace graben::detail {

namespace {

constexpr std::array<double, 13> kLengths = {0.5, 0.7, 0.9, 1.1, 1.35, 1.6, 1.9, 2.3, 2.8, 3.5, 4.5, 6.0, 8.0}; // gaps
constexpr std::array<double, 7> kNoises = {0.0003, 0.001, 0.003, 0.01, 0.03, 0.1, 0.3};
constexpr std::size_t kFirstLength = 5;
constexpr std::size_t kFirstNoise = 3;

/// Walks from the middle of lengths and noises to where none next to it is likelier.
class UphillSearch {
public:
  UphillSearch(const Kriging& kriging, Correlation correlation, double gap) : kriging_(kriging), correlation_(correlation), gap_(gap) {
    while (step()) {
    }
  }

  SurfaceCorrelation found() const { return at(length_, noise_); }
  double unlikeliness() { return unlikeliness(length_, noise_); }

private:
  bool step() {
    const std::array<std::pair<std::size_t, std::size_t>, 4> next = {
      {{length_ + 1, noise_}, {length_ - 1, noise_}, {length_, noise_ + 1}, {length_, noise_ - 1}}}; // one before 0 is none, as one after the last
    for (const auto& [length, noise] : next)
      if (length < kLengths.size() && noise < kNoises.size() && unlikeliness(length, noise) < unlikeliness(length_, noise_)) {
        length_ = length;
        noise_ = noise;
        return true;
      }
    return false;
  }

  SurfaceCorrelation at(std::size_t length, std::size_t noise) const { return {correlation_, kLengths[length] * gap_, kNoises[noise]}; }

  double unlikeliness(std::size_t length, std::size_t noise) {
    const auto [found, fresh] = known_.try_emplace({length, noise}, 0.0);
    if (fresh)
      found->second = kriging_.unlikeliness(at(length, noise));
    return found->second;
  }

  const Kriging& kriging_;
  Correlation correlation_;
  double gap_;
  std::size_t length_ = kFirstLength;
  std::size_t noise_ = kFirstNoise;
  std::map<std::pair<std::size_t, std::size_t>, double> known_;
};

} // namespace

SurfaceCorrelation likeliestCorrelation(const Kriging& kriging, double gap) {
  SurfaceCorrelation best;
  double least = std::numeric_limits<double>::infinity();
  for (const Correlation correlation : {Correlation::Gaussian, Correlation::Matern5over2, Correlation::Matern3over2}) {
    UphillSearch search(kriging, correlation, gap);
    if (search.unlikeliness() < least || !std::isfinite(least)) {
      least = search.unlikeliness();
      best = search.found();
    }
  }
  return best;
}

} // namespace graben::detail
