#include "graben/analysis/statistics.h"

#include "graben/core/threads.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace graben {

namespace {

constexpr std::size_t kGrain = 1 << 17;
constexpr unsigned kShift = 49; // leaves sign, exponent and three bits of the mantissa
constexpr unsigned kFineShift = 35; // leaves as many bits again as there are bins
constexpr std::size_t kBins = std::size_t{1} << (64 - kShift - 1);

/// The bits of values that are not negative are in order as the values are.
std::uint64_t bitsOf(double value) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}

/// How many of the values fall into each bin; those of bin kBins into none.
template <typename BinOf>
std::vector<std::size_t> binned(const std::vector<double>& values, unsigned threads, const BinOf& bin_of) {
  std::vector<std::vector<std::uint32_t>> blocks((values.size() + kGrain - 1) / kGrain);
  parallelBlocks(values.size(), kGrain, threads, [&](std::size_t begin, std::size_t end) {
    std::vector<std::uint32_t> bins(kBins + 1, 0);
    for (std::size_t i = begin; i < end; ++i)
      ++bins[bin_of(bitsOf(values[i]))];
    blocks[begin / kGrain] = std::move(bins);
  });
  std::vector<std::size_t> sums(kBins, 0);
  for (const std::vector<std::uint32_t>& block : blocks)
    for (std::size_t bin = 0; bin < kBins; ++bin)
      sums[bin] += block[bin];
  return sums;
}

/// \param[in,out] below how many values come before the bins; then before the bin found
std::size_t binOfRank(const std::vector<std::size_t>& bins, std::size_t rank, std::size_t& below) {
  std::size_t bin = 0;
  for (; below + bins[bin] <= rank; ++bin)
    below += bins[bin];
  return bin;
}

struct Sums {
  double sum = 0.0;
  double square_sum = 0.0;
  double max = 0.0;
};

} // namespace

std::size_t rankOf(std::size_t count, double q) {
  const auto n = static_cast<double>(count);
  return static_cast<std::size_t>(std::clamp(std::ceil(q * n), 1.0, n)) - 1;
}

RankSearch::RankSearch(const std::vector<double>& values, unsigned threads)
    : values_(values)
    , threads_(threads)
    , bins_(binned(values, threads, [](std::uint64_t bits) { return bits >> kShift; })) {}

double RankSearch::value(std::size_t rank) const {
  std::size_t below = 0;
  const std::size_t leading = binOfRank(bins_, rank, below);
  // Values that crowd in a few bins are told apart by the bits that follow.
  const std::vector<std::size_t> finer =
    binned(values_, threads_, [leading](std::uint64_t bits) { return bits >> kShift == leading ? (bits >> kFineShift) % kBins : kBins; });
  const std::uint64_t wanted = leading << (kShift - kFineShift) | binOfRank(finer, rank, below);
  std::vector<std::vector<double>> blocks((values_.size() + kGrain - 1) / kGrain);
  parallelFor(values_.size(), kGrain, threads_, [&](std::size_t i) {
    if (bitsOf(values_[i]) >> kFineShift == wanted)
      blocks[i / kGrain].push_back(values_[i]);
  });
  std::vector<double> candidates;
  for (const std::vector<double>& block : blocks)
    candidates.insert(candidates.end(), block.begin(), block.end());
  const auto found = candidates.begin() + static_cast<std::ptrdiff_t>(rank - below);
  std::nth_element(candidates.begin(), found, candidates.end());
  return *found;
}

double quantile(std::vector<double>& values, double q) {
  if (values.empty())
    return 0.0;
  const std::size_t rank = rankOf(values.size(), q);
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(rank), values.end());
  return values[rank];
}

DistanceStatistics distanceStatistics(std::vector<double> distances, unsigned threads) {
  DistanceStatistics result;
  result.count = distances.size();
  if (distances.empty())
    return result;
  std::vector<Sums> blocks((distances.size() + kGrain - 1) / kGrain);
  parallelBlocks(distances.size(), kGrain, threads, [&](std::size_t begin, std::size_t end) {
    Sums sums;
    for (std::size_t i = begin; i < end; ++i) {
      const double d = distances[i];
      sums.sum += d;
      sums.square_sum += d * d;
      sums.max = std::max(sums.max, d);
    }
    blocks[begin / kGrain] = sums;
  });
  for (const Sums& block : blocks) {
    result.mean += block.sum;
    result.mean_square += block.square_sum;
    result.max = std::max(result.max, block.max);
  }
  const auto count = static_cast<double>(distances.size());
  result.mean /= count;
  result.mean_square /= count;
  result.rms = std::sqrt(result.mean_square);
  if (blocks.size() > 1) {
    const RankSearch ranks(distances, threads);
    result.p50 = ranks.value(rankOf(distances.size(), 0.5));
    result.p95 = ranks.value(rankOf(distances.size(), 0.95));
  } else {
    result.p50 = quantile(distances, 0.5);
    result.p95 = quantile(distances, 0.95);
  }
  return result;
}

} // namespace graben
