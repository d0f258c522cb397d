#include "likeliest_correlation.h"

#include "pick_likelihood.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

namespace graben::detail {

namespace {

constexpr std::array<double, 13> kLengths = {0.5, 0.7, 0.9, 1.1, 1.35, 1.6, 1.9, 2.3, 2.8, 3.5, 4.5, 6.0, 8.0}; // gaps
constexpr std::array<double, 5> kNoises = {0.003, 0.01, 0.03, 0.1, 0.3}; // smaller ones are below what nodes can hold
constexpr std::array<double, 6> kMisties = {0.0, 0.5, 1.0, 2.0, 4.0, 8.0}; // noises

/// Which of the lengths, noises and misties.
using Choice = std::array<std::size_t, 3>;
constexpr std::size_t kMistie = 2;
constexpr Choice kCounts = {kLengths.size(), kNoises.size(), kMisties.size()};
constexpr Choice kFirst = {5, 1, 0};
constexpr std::size_t kFirstMistie = 2;
constexpr double kDoubt = 6.0; // twice the logarithm of how much likelier misties must be than none: on few lines they are a little by chance

/// Walks to where nothing next to it is likelier.
class UphillSearch {
public:
  UphillSearch(const PickLikelihood& picks, Correlation correlation, double gap) : picks_(picks), correlation_(correlation), gap_(gap) {
    climb({0, 1});
  }

  /// On from where it is, with misties if they make the picks likelier.
  void tryMisties() {
    const Choice without = choice_;
    const double unlikeliness_without = unlikeliness();
    choice_[kMistie] = kFirstMistie;
    climb({0, 1, kMistie});
    if (!(unlikeliness() < unlikeliness_without - kDoubt))
      choice_ = without;
  }

  LikeliestCorrelation found() { return {at(choice_), told(choice_).deviation}; }
  double unlikeliness() { return told(choice_).unlikeliness; }

private:
  void climb(const std::vector<std::size_t>& axes) {
    while (std::any_of(axes.begin(), axes.end(), [this](std::size_t axis) { return step(axis); })) {
    }
  }

  bool step(std::size_t axis) {
    for (const std::size_t way : {choice_[axis] + 1, choice_[axis] - 1}) { // one before 0 is none, as one after the last
      Choice next = choice_;
      next[axis] = way;
      if (way < kCounts[axis] && told(next).unlikeliness < unlikeliness()) {
        choice_ = next;
        return true;
      }
    }
    return false;
  }

  SurfaceCorrelation at(const Choice& choice) const {
    const double noise = kNoises[choice[1]];
    return {correlation_, kLengths[choice[0]] * gap_, noise, kMisties[choice[2]] * noise};
  }

  const PickLikelihood::Told& told(const Choice& choice) {
    const auto [found, fresh] = known_.try_emplace(choice);
    if (fresh)
      found->second = picks_.of(at(choice));
    return found->second;
  }

  const PickLikelihood& picks_;
  Correlation correlation_;
  double gap_;
  Choice choice_ = kFirst;
  std::map<Choice, PickLikelihood::Told> known_;
};

} // namespace

LikeliestCorrelation likeliestCorrelation(const KrigedPlaces& picks, const FaultNetwork& faults, double gap, unsigned threads) {
  const PickLikelihood likelihood(picks, faults, gap, threads);
  LikeliestCorrelation best;
  double least = std::numeric_limits<double>::infinity();
  for (const Correlation correlation : {Correlation::Gaussian, Correlation::Matern5over2, Correlation::Matern3over2}) {
    UphillSearch search(likelihood, correlation, gap);
    if (!picks.lines.empty())
      search.tryMisties();
    if (search.unlikeliness() < least || !std::isfinite(least)) {
      least = search.unlikeliness();
      best = search.found();
    }
  }
  return best;
}

} // namespace graben::detail
