#include "graben/analysis/rank_search.h"

#include <algorithm>
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
  for (std::size_t i = 0; i < counts_.size(); ++i) {
    const auto [rank, low, high] = search_->bounds_[i];
    Counts& counts = counts_[i];
    std::size_t below = 0;
    for (const double* v = values; v < values + count; ++v) {
      below += *v < low ? 1 : 0;
      if (!(*v >= low && *v <= high))
        continue;
      if (*v == low)
        ++counts.at_low;
      else if (*v == high)
        ++counts.at_high;
      else
        counts.between.push_back(*v);
    }
    counts.below += below;
  }
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
