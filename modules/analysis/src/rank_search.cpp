#include "graben/analysis/rank_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace graben {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kDeviations = 4.0; // of the place of a value in a sample that is chosen at random, at most

} // namespace

std::size_t rankOf(std::size_t count, double q) {
  const auto n = static_cast<double>(count);
  return static_cast<std::size_t>(std::clamp(std::ceil(q * n), 1.0, n)) - 1;
}

RankSearch::RankSearch(std::vector<double> sample, std::size_t count, const std::vector<std::size_t>& ranks) {
  std::sort(sample.begin(), sample.end());
  const auto size = static_cast<double>(sample.size());
  for (const std::size_t rank : ranks) {
    const double share = (static_cast<double>(rank) + 0.5) / static_cast<double>(count);
    const double margin = 2.0 + kDeviations * std::sqrt(size * share * (1.0 - share));
    const double low = std::floor(share * size - margin);
    const double high = std::ceil(share * size + margin);
    bounds_.push_back({rank, low < 0.0 ? -kInfinity : sample[static_cast<std::size_t>(low)],
                       high < size ? sample[static_cast<std::size_t>(high)] : kInfinity});
  }
}

void RankSearch::Tally::see(const double* values, std::size_t count) {
  constexpr std::size_t few = 512;
  std::array<double, few> inside; // NOLINT: filled as far as it is read
  for (std::size_t first = 0; first < count; first += few) {
    const std::size_t last = std::min(first + few, count);
    for (std::size_t i = 0; i < counts_.size(); ++i) {
      const auto [rank, low, high] = search_->bounds_[i];
      std::size_t below = 0;
      std::size_t found = 0;
      for (std::size_t v = first; v < last; ++v) { // without branches, as those taken now and then cost most
        inside[found] = values[v];
        below += values[v] < low ? 1 : 0;
        found += static_cast<std::size_t>(values[v] >= low) & static_cast<std::size_t>(values[v] <= high);
      }
      counts_[i].below += below;
      counts_[i].keep(inside.data(), found, low, high);
    }
  }
}

void RankSearch::Tally::Counts::keep(const double* inside, std::size_t count, double low, double high) {
  for (std::size_t v = 0; v < count; ++v)
    if (inside[v] == low)
      ++at_low;
    else if (inside[v] == high)
      ++at_high;
    else
      between.push_back(inside[v]);
}

bool RankSearch::find(const std::vector<Tally>& tallies, std::vector<double>& values) {
  values.clear();
  bool all = true;
  for (std::size_t i = 0; i < bounds_.size(); ++i) {
    Bounds& bounds = bounds_[i];
    Tally::Counts sum;
    for (const Tally& tally : tallies) {
      const Tally::Counts& counts = tally.counts_[i];
      sum.below += counts.below;
      sum.at_low += counts.at_low;
      sum.at_high += counts.at_high;
      sum.between.insert(sum.between.end(), counts.between.begin(), counts.between.end());
    }
    const std::size_t above_low = sum.below + sum.at_low;
    const std::size_t up_to_high = above_low + sum.between.size();
    if (bounds.rank < sum.below || bounds.rank >= up_to_high + sum.at_high) {
      bounds.low = -kInfinity;
      bounds.high = kInfinity;
      all = false;
    } else if (bounds.rank < above_low) {
      values.push_back(bounds.low);
    } else if (bounds.rank >= up_to_high) {
      values.push_back(bounds.high);
    } else {
      const auto found = sum.between.begin() + static_cast<std::ptrdiff_t>(bounds.rank - above_low);
      std::nth_element(sum.between.begin(), found, sum.between.end());
      values.push_back(*found);
    }
  }
  return all;
}

} // namespace graben
