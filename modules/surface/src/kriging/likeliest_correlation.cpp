#include "likeliest_correlation.h"

#include "graben/core/threads.h"

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

namespace graben::detail {

namespace {

constexpr std::array<double, 13> kLengths = {0.5, 0.7, 0.9, 1.1, 1.35, 1.6, 1.9, 2.3, 2.8, 3.5, 4.5, 6.0, 8.0}; // gaps
constexpr std::array<double, 7> kNoises = {0.0003, 0.001, 0.003, 0.01, 0.03, 0.1, 0.3};
constexpr std::size_t kFirstLength = 5;
constexpr std::size_t kFirstNoise = 3;

/// How unlikely the picks are under a correlation, see KrigingSystem: of all windows that are compared.
class Unlikeliness {
public:
  Unlikeliness(const Kriging& kriging, unsigned threads) : systems_(kriging.systemsToCompare()), threads_(threads) {}

  double of(const SurfaceCorrelation& correlation) const {
    std::vector<double> each(systems_.size());
    parallelFor(each.size(), 1, threads_, [&](std::size_t i) { each[i] = systems_[i].unlikeliness(correlation); });
    return std::accumulate(each.begin(), each.end(), 0.0);
  }

private:
  std::vector<KrigingSystem> systems_;
  unsigned threads_;
};

/// Walks from the middle of lengths and noises to where none next to it is likelier.
class UphillSearch {
public:
  UphillSearch(const Unlikeliness& picks, Correlation correlation, double gap) : picks_(picks), correlation_(correlation), gap_(gap) {
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
      found->second = picks_.of(at(length, noise));
    return found->second;
  }

  const Unlikeliness& picks_;
  Correlation correlation_;
  double gap_;
  std::size_t length_ = kFirstLength;
  std::size_t noise_ = kFirstNoise;
  std::map<std::pair<std::size_t, std::size_t>, double> known_;
};

} // namespace

SurfaceCorrelation likeliestCorrelation(const Kriging& kriging, double gap, unsigned threads) {
  const Unlikeliness picks(kriging, threads);
  SurfaceCorrelation best;
  double least = std::numeric_limits<double>::infinity();
  for (const Correlation correlation : {Correlation::Gaussian, Correlation::Matern5over2, Correlation::Matern3over2}) {
    UphillSearch search(picks, correlation, gap);
    if (search.unlikeliness() < least || !std::isfinite(least)) {
      least = search.unlikeliness();
      best = search.found();
    }
  }
  return best;
}

} // namespace graben::detail
